"""From analysis to design: what keeps a vehicle stable, and what does it best."""
