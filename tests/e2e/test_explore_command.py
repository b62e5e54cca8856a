"""beal explore, as far as it can be seen without a browser."""

import socket


def test_a_port_that_is_taken_is_refused(beal_here):
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        done = beal_here("explore", "--no-browser", "--port", taken.getsockname()[1])
    assert (done.returncode, done.stdout) == (2, "")
    assert "beal: --port: " in done.stderr


def test_a_port_out_of_range_is_refused(beal_here):
    done = beal_here("explore", "--no-browser", "--port", 70000)
    assert done.returncode == 2
    assert "beal: --port: 70000 cannot be used" in done.stderr


def test_a_bad_model_is_refused_before_anything_is_served(beal_here, written):
    done = beal_here("explore", written("[[stage]]\nlength = -1\n"), "--no-browser")
    assert done.returncode == 2
    assert "stage[0].length" in done.stderr
