"""Other programs: their models become vehicles, vehicles and results become their files; one module per partner."""
