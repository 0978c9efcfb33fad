"""Tools of the lab packages: `meshes` draws, `urdf` looks into descriptions, `simulation` helps tests."""
