#error "Sensor managers do not exist here (docs/differences.md, 'MoveIt in C++')"
