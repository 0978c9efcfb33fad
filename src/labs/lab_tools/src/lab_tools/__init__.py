"""Tools of the lab packages: `meshes` draws them, `urdf` looks into descriptions."""
