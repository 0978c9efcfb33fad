#pragma once

#include <string>

namespace move_group
{
static const std::string NODE_NAME = "move_group";
}
