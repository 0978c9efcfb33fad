// Where Ubuntu has ignition-math 6; sources name the folder in full.
#pragma once
#include <ignition/math.hh>
