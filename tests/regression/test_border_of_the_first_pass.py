"""Maps that look at soft joints a second time, on graded tables, once kept the border that the first look had seen."""

import numpy as np

from beal.stability.kernels.rules import FLUTTER, UNDECIDED
from beal.stability.scan import Found
from beal.study import batch
from beal.study.study import Solve
from beal.vehicle import catalog


def test_what_is_decided_anew_has_the_border_of_that_decision(monkeypatch):
    answers = iter([(UNDECIDED, [True, True, False, False]), (FLUTTER, [False, True, False, True])])

    def scan(tables, weights):
        kind, border = next(answers)
        thrust, W, error = np.full((3, 4), [[50.0], [100.0], [1e-9]])
        return Found(np.full(4, kind), np.ones(4, dtype=np.intp), thrust, W, error, np.array(border))

    monkeypatch.setattr(batch, "scan", scan)
    paths = ("joint[0].rotational_stiffness",)
    found = batch.solve_together(catalog.tsto(0.6, 1.0, 1e4), paths, np.full((4, 1), 100.0), Solve())
    assert found.kind.tolist() == [FLUTTER] * 4
    assert found.border.tolist() == [False, True, False, True]
