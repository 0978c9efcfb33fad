#pragma once

#define SDFORMAT_VISIBLE __attribute__((visibility("default")))
#define SDFORMAT_HIDDEN __attribute__((visibility("hidden")))
