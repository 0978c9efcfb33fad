"""Buildings from plans: see :mod:`building_editor.building`."""
