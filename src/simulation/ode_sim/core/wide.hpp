// Four numbers at a time where the inner loops are. Nothing is summed up across them, so that the bits are each processor's.
#pragma once

// On a function: compiled for today's vector units as well, chosen when the library is loaded.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ODE_SIM_ALSO_AVX2 __attribute__((target_clones("avx2", "default")))
#else
#define ODE_SIM_ALSO_AVX2
#endif

namespace ode_sim {

typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));  // allocators know nothing of larger alignments

}  // namespace ode_sim
