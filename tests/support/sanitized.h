// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <cstddef>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) // GCC
#define HEARTH_TEST_SANITIZED
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define HEARTH_TEST_SANITIZED
#endif
#endif

namespace hearth::test
{

/// True if compiled for a sanitizer. Each step takes ten times as long there, and a wrong access is wrong at
/// any size: tests try as many kinds of input, but fewer and smaller ones of each kind.
#ifdef HEARTH_TEST_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

/// Return the number of random trials of a test: a twentieth of `count` under a sanitizer, at least one.
constexpr size_t trials(size_t count)
{
    return kSanitized ? (count + 19) / 20 : count;
}

/// File size in bytes from which an asset takes long under a sanitizer.
inline constexpr size_t kLargeFile = 100 << 10;

} // namespace hearth::test
