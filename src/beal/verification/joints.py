"""Missiles of two beams without damping: joints that turn, and joints that shear."""

from beal.vehicle.catalog import mladenov_sugiyama
from beal.verification.case import Case, Expected, at_thrust, called, divergence, flutter

SOURCE = "Mladenov & Sugiyama (1997)"
ROTATIONAL_FREQUENCIES = {  # station and stiffness
    (0.5, 1.0): ("11.81821231", "61.67282287", "95.75679336"),
    (0.5, 10.0): ("19.97949333", "61.67282287", "112.1218065"),
    (0.5, 100.0): ("22.0961309", "61.67282287", "119.749152"),
    (0.4, 1.0): ("12.40472897", "53.52177895", "114.6002063"),
    (0.4, 10.0): ("20.29339834", "59.11267743", "119.0092498"),
    (0.4, 100.0): ("22.1395416", "61.35186777", "120.6705937"),
    (0.3, 1.0): ("14.40297983", "44.29958857", "112.5608692"),
    (0.3, 10.0): ("21.09960322", "56.19689875", "117.7110313"),
    (0.3, 100.0): ("22.23959828", "60.99210326"),
    (0.25, 1.0): ("16.12189208", "41.58692343", "102.171032"),
    (0.25, 10.0): ("21.55529224", "56.21981836", "113.1576517"),
    (0.25, 100.0): ("22.29008085", "61.03958174"),
}
SHEAR_FREQUENCIES = {
    (0.5, 10.0): ("12.49869258", "22.37328545", "90.39640677"),
    (0.5, 100.0): ("22.37328545", "35.41373155", "99.1230029"),
    (0.5, 1000.0): ("22.37328545", "57.64933246", "120.9033917"),
    (0.25, 10.0): ("10.27851877", "35.92625198", "64.58245962"),
    (0.25, 100.0): ("19.83617605", "53.51500846", "69.37815897"),
    (0.25, 1000.0): ("22.11171906", "61.33911234", "116.3656159"),
}
ROTATIONAL: dict[tuple[float, float], dict[str, Expected]] = {
    (0.25, 0.5): divergence("17.1519271093"),
    (0.5, 0.5): divergence("7.40974340316"),
    (0.75, 0.5): divergence("11.3942088165"),
    (0.25, 1.0): divergence("31.1373614774"),
    (0.5, 1.0): divergence("13.7930387097"),
    (0.75, 1.0): divergence("23.6384177092"),
    (0.25, 5.0): flutter("97.8518924845", "16.2437769596"),
    (0.5, 5.0): divergence("44.505184076"),
    (0.75, 5.0): flutter("53.3785384478", "23.754873741"),
    (0.25, 10.0): flutter("102.7115938", "19.904661568"),
    (0.5, 10.0): divergence("63.2458520105"),
    (0.75, 10.0): flutter("71.3309931076", "24.5333365567"),
    (0.25, 20.0): flutter("106.057182519", "21.5374211925"),
    (0.5, 20.0): flutter("113.46346307", "19.8763511477"),
    (0.75, 20.0): flutter("87.0886221376", "24.3121817941"),
    (0.25, 100.0): flutter("108.952415377", "22.7747211195"),
    (0.5, 100.0): flutter("110.412006099", "22.4925304022"),
    (0.75, 100.0): flutter("104.617059496", "23.4431018155"),
    (0.25, 1000.0): flutter("109.615432144", "23.0436807181"),
    (0.5, 1000.0): flutter("109.760838872", "23.0163387465"),
    (0.75, 1000.0): flutter("109.171330768", "23.1136897997"),
}
# Inertial: k_s s = V, moments not balanced. Otherwise the force is normal to the section, whose moment jumps by -N s.
SHEAR: dict[tuple[float, float], dict[str, dict[str, Expected]]] = {
    (0.5, 100.0): {
        "inertial": flutter("57.7307499924", "19.8467"),
        "mean": flutter("56.2243725932", "18.9742761935"),
    },
    (0.5, 200.0): {
        "inertial": flutter("82.6162584078", "21.9520"),
        "mean": flutter("71.2277304722", "19.3299383556"),
    },
    (0.5, 500.0): {
        "inertial": flutter("99.0764464744", "23.1888"),
        "mean": flutter("88.0542657525", "20.5275679736"),
    },
    (0.5, 1000.0): {
        "inertial": flutter("104.438764357", "23.2420"),
        "mean": flutter("97.0976231714", "21.4833884793"),
    },
    (0.5, 10000.0): {
        "inertial": flutter("109.168763367", "23.0998"),
        "mean": flutter("108.215379962", "22.8763885284"),
    },
    (0.25, 100.0): {
        "inertial": divergence("70.5830304978"),
        "mean": flutter("107.588603372", "16.9882742872"),
    },
    (0.25, 1000.0): {
        "inertial": flutter("111.350105886", "22.0826"),
        "mean": flutter("108.913118546", "22.2327370055"),
    },
    (0.75, 100.0): {
        "inertial": flutter("35.6264382315", "30.2490"),
        "mean": divergence("47.3659010173"),
    },
    (0.75, 200.0): {
        "inertial": flutter("41.9125457334", "56.9792"),
        "mean": divergence("58.7647802839"),
    },
    (0.75, 1000.0): {
        "inertial": flutter("105.159470608", "26.1359"),
        "mean": flutter("109.578525386", "20.8954404129"),
    },
}

CASES = [
    *(
        Case(*called(mladenov_sugiyama, *joint), SOURCE, *at_thrust(0.0, row))
        for joint, row in ROTATIONAL_FREQUENCIES.items()
    ),
    *(
        Case(*called(mladenov_sugiyama, station, shear_stiffness=stiffness), SOURCE, *at_thrust(0.0, row))
        for (station, stiffness), row in SHEAR_FREQUENCIES.items()
    ),
    *(Case(*called(mladenov_sugiyama, *joint), SOURCE, expected) for joint, expected in ROTATIONAL.items()),
    *(
        Case(*called(mladenov_sugiyama, station, shear_stiffness=stiffness, shear_axis=axis), SOURCE, expected)
        for (station, stiffness), axes in SHEAR.items()
        for axis, expected in axes.items()
    ),
]
