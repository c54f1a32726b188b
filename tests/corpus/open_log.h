// Log format of the preloaded library: one record for each open, a letter and a path, closed by a zero byte.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

namespace hearth::corpus
{

/// Environment variable that names the log file.
inline constexpr const char* kOpenLogVariable = "HEARTH_CORPUS_OPEN_LOG";

/// File name of the library, which lies beside the programs that preload it.
inline constexpr const char* kOpenLogLibrary = "libhearth_corpus_open_log.so";

inline constexpr char kOpenForReading = 'r'; ///< the real path of the file
inline constexpr char kOpenForWriting = 'w'; ///< the real path of the file
inline constexpr char kOpenFailed = 'f';     ///< the requested path, made absolute
inline constexpr char kOpenNetwork = 'n';    ///< a connection

} // namespace hearth::corpus
