#pragma once
#include <gazebo/util/system.hh>
#include <gazebo/common/common.hh>
