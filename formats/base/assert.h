// Contracts between parts of the program. Never used on the contents of a file: those are Results.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

namespace hearth
{
/// Prints the broken contract and aborts.
[[noreturn]] void assertionFailed(const char* condition, const char* file, int line);
} // namespace hearth

// Without folders: no path of the machine that built it is in a program that is given away.
#ifdef __FILE_NAME__
#define HEARTH_FILE_NAME __FILE_NAME__
#else
#define HEARTH_FILE_NAME __FILE__
#endif

/// A broken contract is a defect of the caller; always checked, in every build.
#define HEARTH_ASSERT(condition)                                                                             \
    (static_cast<bool>(condition) ? static_cast<void>(0)                                                     \
                                  : ::hearth::assertionFailed(#condition, HEARTH_FILE_NAME, __LINE__))

/// The same, for inner loops of the runtime: checked unless NDEBUG.
#ifdef NDEBUG
#define HEARTH_RUNTIME_ASSERT(condition) static_cast<void>(0)
#else
#define HEARTH_RUNTIME_ASSERT(condition) HEARTH_ASSERT(condition)
#endif
