#pragma once
// Gazebo's own plugins mark their work for a profiler, which is switched off in Gazebo as it is packaged; so it is here.
#define IGN_PROFILE_THREAD_NAME(name) ((void)(name))
#define IGN_PROFILE_LOG_TEXT(text) ((void)(text))
#define IGN_PROFILE_LOG_VALUE(name, value) ((void)(value))
#define IGN_PROFILE_BEGIN(name) ((void)(name))
#define IGN_PROFILE_END() ((void)0)
#define IGN_PROFILE(name) ((void)(name))
#define IGN_PROFILE_L(name, line) ((void)(name))
