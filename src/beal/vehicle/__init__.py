"""What the user describes: the parts of a vehicle, the vehicle, its file format and a catalog."""
