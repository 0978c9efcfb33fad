#error "moveit::tools::Profiler does not exist here: use perf or gprof (docs/differences.md, 'MoveIt in C++')"
