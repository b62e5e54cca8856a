"""Beal's missile with directional control."""

from functools import partial

from beal.vehicle.catalog import beal_controlled
from beal.verification.case import Case, Expected, called, divergence, flutter, printed
from beal.verification.measure import controlled, controlled_frequencies, frequency_name

WU = "Wu (1975)"
CONTROLLED = ", controlled"
ZERO_FREQUENCY = divergence("25.638181376802", of=CONTROLLED)
THRUSTS = {  # gain, station of the sensor
    (0.01, 0.5): ZERO_FREQUENCY,
    (0.1, 0.3): ZERO_FREQUENCY,
    (0.5, 1.0): ZERO_FREQUENCY,
    (1.0, 0.7): ZERO_FREQUENCY,
    (2.0, 0.5): ZERO_FREQUENCY,
    (5.0, 0.75): ZERO_FREQUENCY,
    (10.0, 1.0): ZERO_FREQUENCY,
    (1.0, 0.0): flutter("16.9360037339", "10.852086074", of=CONTROLLED),
    (1.5, 0.0): flutter("9.01123993909", "12.3024250379", of=CONTROLLED),
    (1.5, 0.25): flutter("10.3892414942", "12.5400772542", of=CONTROLLED),
    (2.0, 0.0): flutter("6.44525552556", "12.6711106829", of=CONTROLLED),
    (2.0, 0.25): flutter("7.30103626101", "13.0036118987", of=CONTROLLED),
    (5.0, 0.0): flutter("2.4294792709", "13.1970563974", of=CONTROLLED),
    (5.0, 0.25): flutter("2.71247239187", "13.6192627878", of=CONTROLLED),
    (5.0, 0.5): flutter("16.1158602734", "35.5292945283", of=CONTROLLED),
    (10.0, 0.0): flutter("1.19626069553", "13.3489900286", of=CONTROLLED),
    (10.0, 0.25): flutter("1.33183266795", "13.7921891066", of=CONTROLLED),
    (10.0, 0.5): flutter("8.02998981024", "36.0231132568", of=CONTROLLED),
    (10.0, 0.75): flutter("12.904128121", "97.2779469224", of=CONTROLLED),
}
FREQUENCIES = {  # gain, station of the sensor, thrust
    (1.0, 0.5, 10.0): ("6.29797267869", "21.2865122364", "58.0224996778"),
    (1.0, 0.0, 10.0): ("7.67405461072", "16.5428955273", "62.1868953124"),
    (0.1, 0.75, 5.0): ("1.56369915269", "21.8532298763", "60.7750116946"),
}

CASES = [
    *(Case(*called(beal_controlled, *law), WU, expected, controlled) for law, expected in THRUSTS.items()),
    *(
        Case(
            *called(beal_controlled, gain, station),
            WU,
            {
                f"{frequency_name(number, thrust)}{CONTROLLED}": Expected(printed(text))
                for number, text in enumerate(row, 1)
            },
            partial(controlled_frequencies, thrust=thrust, count=len(row)),
        )
        for (gain, station, thrust), row in FREQUENCIES.items()
    ),
]
