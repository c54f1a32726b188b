// SIMD arithmetic on four doubles side by side, and functions that are compiled for several instruction sets.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>

// Inlines a function, or a lambda if written after its parameters, wherever it is called.
#define HEARTH_INLINE __attribute__((always_inline))

namespace hearth::animation_bounds
{

/// Vector of four doubles. Functions take it by reference: registers that hold it differ between instruction
/// sets.
using Four = double __attribute__((vector_size(4 * sizeof(double))));
using FourMasks = int64_t __attribute__((vector_size(4 * sizeof(int64_t))));

/// Return the absolute values.
HEARTH_INLINE inline void setAbsolute(const Four& x, Four& result)
{
    result = (Four)((FourMasks)x & INT64_MAX);
}

HEARTH_INLINE inline void load(const std::array<double, 4>& numbers, Four& result)
{
    std::memcpy(&result, numbers.data(), sizeof result);
}

HEARTH_INLINE inline void store(const Four& numbers, std::array<double, 4>& result)
{
    std::memcpy(result.data(), &numbers, sizeof numbers);
}

/// Compute the square roots of numbers of at least 0.
HEARTH_INLINE inline void setSquareRoot(Four& x)
{
#if defined(__SSE2__)
    // std::sqrt sets errno, so compilers do not vectorise it
    using Two = double __attribute__((vector_size(2 * sizeof(double))));
    const Two first = __builtin_ia32_sqrtpd(__builtin_shufflevector(x, x, 0, 1));
    const Two second = __builtin_ia32_sqrtpd(__builtin_shufflevector(x, x, 2, 3));
    x = __builtin_shufflevector(first, second, 0, 1, 2, 3);
#else
    for (size_t i = 0; i < 4; ++i)
        x[i] = std::sqrt(x[i]);
#endif
}

/// Transpose the 4 x 4 matrix of the rows r0 to r3 into four columns.
HEARTH_INLINE inline void transpose(const Four& r0, const Four& r1, const Four& r2, const Four& r3,
                                    Four* columns)
{
    const Four low01 = __builtin_shufflevector(r0, r1, 0, 4, 2, 6);
    const Four high01 = __builtin_shufflevector(r0, r1, 1, 5, 3, 7);
    const Four low23 = __builtin_shufflevector(r2, r3, 0, 4, 2, 6);
    const Four high23 = __builtin_shufflevector(r2, r3, 1, 5, 3, 7);
    columns[0] = __builtin_shufflevector(low01, low23, 0, 1, 4, 5);
    columns[1] = __builtin_shufflevector(high01, high23, 0, 1, 4, 5);
    columns[2] = __builtin_shufflevector(low01, low23, 2, 3, 6, 7);
    columns[3] = __builtin_shufflevector(high01, high23, 2, 3, 6, 7);
}

#if defined(__x86_64__)
template <typename Function>
__attribute__((target("avx2"))) void callWithAvx2(const Function& function)
{
    function();
}
#endif

/// Call a function that was compiled for the widest vectors of this machine. All versions return the same
/// numbers: they do the operations of single numbers, in the same order, and the project never fuses a
/// multiplication with an addition.
/// function  must be a HEARTH_INLINE lambda; what it calls is compiled likewise only if it is inlined
template <typename Function>
void callWithWideVectors(const Function& function)
{
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx2"))
    {
        callWithAvx2(function);
        return;
    }
#endif
    function();
}

} // namespace hearth::animation_bounds
