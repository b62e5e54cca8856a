"""From analysis to design: how critical thrusts and frequencies depend on every quantity of a vehicle."""
