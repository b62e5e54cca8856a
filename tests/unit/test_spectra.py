"""Envelopes and spectra of time histories that are known."""

import math
from dataclasses import replace

import numpy as np
import pytest

from beal.errors import ModelError
from beal.motion import ModeShape, amplitude_spectrum, envelope, response
from beal.vehicle import Sensor, catalog

MOTION = response(
    catalog.beal().model_copy(update={"sensors": (Sensor(name="imu", station=0.1),)}),
    duration=1.0,
    thrust=0.0,
    step=0.1,
    modes=1,
    method="exact",
    initial=ModeShape(1, 0.01),
)
STEP = 0.01
TIME = STEP * np.arange(4001)


def history(displacement, rate):
    return replace(MOTION, time=TIME, step=STEP, displacement=displacement[None], rate=rate[None])


def test_envelope_of_a_growing_motion_on_an_offset_is_its_exponential():
    root = complex(0.05, 7.0)
    motion = np.exp(root * TIME)
    time, amplitude = envelope(history(motion.real + 3.0, (root * motion).real), "imu")
    np.testing.assert_allclose(amplitude, np.exp(0.05 * time), rtol=1e-3)  # (growth * half a period)^2 / 8 and sampling
    assert len(time) == pytest.approx(7.0 * 40.0 / math.pi, abs=2)


def test_envelope_of_a_beat_vanishes_where_the_motions_cancel():
    a, b = 7.0, 7.5
    motion = history(np.sin(a * TIME) + np.sin(b * TIME), a * np.cos(a * TIME) + b * np.cos(b * TIME))
    time, amplitude = envelope(motion, "imu")
    np.testing.assert_allclose(amplitude, 2 * abs(np.cos((b - a) * time / 2)), atol=0.11)  # half a period's change
    beat = 2 * math.pi / (b - a)
    assert amplitude[abs(time - beat / 2).argmin()] < 0.2
    assert amplitude[abs(time - beat).argmin()] > 1.9


def test_spectrum_shows_the_amplitude_and_frequency_of_each_line_and_no_drift():
    bins = 2 * math.pi / 40.0 * np.array([20, 171])
    motion = history(0.3 * np.sin(bins[0] * TIME) + 0.02 * np.cos(bins[1] * TIME) + 5 - 2 * TIME, 0 * TIME)
    frequency, amplitude = amplitude_spectrum(motion, "imu")
    assert (len(frequency), frequency[0], frequency[-1]) == (2001, 0.0, pytest.approx(math.pi / STEP))
    assert frequency[[20, 171]] == pytest.approx(bins)
    assert amplitude[[20, 171]] == pytest.approx([0.3, 0.02], rel=2e-2)  # the line fitted to the sine is not quite 0
    assert abs(amplitude[180:]).max() < 1e-4
    assert amplitude[19] == pytest.approx(0.15, rel=2e-2)


def test_what_is_no_sensor_or_quantity_or_too_short_is_refused():
    with pytest.raises(ModelError, match="quantity: must be one of displacement, rate, slope, found 'acceleration'"):
        envelope(MOTION, "imu", "acceleration")
    with pytest.raises(ModelError, match=r"quantity: must be one of displacement, .*slope_rate, found 'jerk'"):
        amplitude_spectrum(MOTION, "imu", "jerk")
    with pytest.raises(ModelError, match="sensor: must be one of imu, found 'nose'"):
        amplitude_spectrum(MOTION, "nose")
    short = replace(MOTION, displacement=MOTION.displacement[:, :7])
    with pytest.raises(ModelError, match="spectrum: needs at least 8 samples, found 7"):
        amplitude_spectrum(short, "imu")
