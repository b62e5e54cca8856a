"""The explorer: a page in the browser on which a vehicle is played with, and the server behind it."""
