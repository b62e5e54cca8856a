"""Many vehicles: grids over any quantity of a model, solved in blocks, stored so that they can be resumed."""
