// The log that the preloaded library writes: one record an open, a letter and a path, closed by a zero byte.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

namespace hearth::corpus
{

/// Environment variable that names the log file.
inline constexpr const char* kOpenLogVariable = "HEARTH_CORPUS_OPEN_LOG";

/// The library's file, beside the programs that preload it.
inline constexpr const char* kOpenLogLibrary = "libhearth_corpus_open_log.so";

inline constexpr char kOpenForReading = 'r'; ///< the real path of the file
inline constexpr char kOpenForWriting = 'w'; ///< the real path of the file
inline constexpr char kOpenFailed = 'f';     ///< the path that was asked for, made absolute
inline constexpr char kOpenNetwork = 'n';    ///< a connection

} // namespace hearth::corpus
