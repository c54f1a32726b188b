// Runs many command lines in one process: main() of a cooker, with its option --batch.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <functional>

namespace hearth::tools
{

/// Record separator of JSON text sequences (RFC 7464): starts the report of a command line in a batch's
/// output. No message of Hearth contains it.
inline constexpr char kRecordSeparator = '\x1E';

/// Run `program`, which takes a command line and returns its exit code: once with the arguments of main(),
/// or, if --batch is the only argument, for each line of stdin. A line is a JSON array of strings, without
/// the program's name. Each command line runs as if alone, on one thread: its stdin and stdout are /dev/null,
/// its messages go to stderr. When it has ended, stdout gets kRecordSeparator, {"exit": 0, "seconds": 0.1,
/// "cpu_seconds": 0.1, "peak_rss_bytes": 8000000} and a newline. The peak is the peak of the whole process
/// during that time. Exceptions are reported as by runProgram.
///
/// name     program name, for messages
/// returns  the exit code; for a batch 0, or 2 if a line is no such array
int runCooker(const char* name, int argc, char** argv, const std::function<int(int, char**)>& program);

} // namespace hearth::tools
