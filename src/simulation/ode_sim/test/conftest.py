"""Makes the helpers of this folder (physics_models and others) importable from the tests in the folders below it."""
