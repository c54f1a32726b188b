// Asserts contracts between parts of the program. Never use them on the contents of a file: those are
// Results.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

namespace hearth
{
/// Print the broken contract and abort.
[[noreturn]] void assertionFailed(const char* condition, const char* file, int line);
} // namespace hearth

// Without folders, so that a distributed program contains no path of the build machine.
#ifdef __FILE_NAME__
#define HEARTH_FILE_NAME __FILE_NAME__
#else
#define HEARTH_FILE_NAME __FILE__
#endif

/// Check a contract in every build. A broken contract is a defect of the caller.
#define HEARTH_ASSERT(condition)                                                                             \
    (static_cast<bool>(condition) ? static_cast<void>(0)                                                     \
                                  : ::hearth::assertionFailed(#condition, HEARTH_FILE_NAME, __LINE__))

/// Check a contract in inner loops, or by a pass over many values: disabled by NDEBUG.
#ifdef NDEBUG
#define HEARTH_RUNTIME_ASSERT(condition) static_cast<void>(0)
#else
#define HEARTH_RUNTIME_ASSERT(condition) HEARTH_ASSERT(condition)
#endif
