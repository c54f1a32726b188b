// One process for many command lines: main() of a cooker, and its option --batch.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <functional>

namespace hearth::tools
{

/// Starts the end of a command line in a batch's output: a JSON text of RFC 7464. No message of Hearth holds it.
inline constexpr char kRecordSeparator = '\x1E';

/// Run `program`, which takes a command line and returns its exit code: once with the arguments of main(), or, where --batch
/// is the only one, for each line of stdin until that ends. A line is a JSON array of words, without the program's name.
/// Each runs as if alone, on one thread: its stdin and stdout are nowhere, its messages go to stderr. When it has ended,
/// stdout gets kRecordSeparator, {"exit": 0, "seconds": 0.1, "cpu_seconds": 0.1, "peak_rss_bytes": 8000000} and a newline.
/// The peak is the whole process's during that time. What throws is told as by runProgram.
///
/// name     of the program, for messages
/// returns  the exit code; of a batch 0, or 2 where a line is no such array
int runCooker(const char* name, int argc, char** argv, const std::function<int(int, char**)>& program);

} // namespace hearth::tools
