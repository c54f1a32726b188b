// Expands the sources on a command line: files, folders, patterns.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// True if the name has the extension of a model: glTF, GLB, OBJ, PLY, STL, OFF or Draco.
bool isModelFile(const std::string& path);

/// Return the files that words stand for, in their order.
/// - A folder stands for all models in it and below, sorted by path: glTF, GLB, OBJ, PLY, STL, OFF and Draco
///   files. Images do not count, because models refer to images that lie there, too.
/// - A pattern ("props/**/*.glb", quoted so that the shell leaves it alone) stands for all matching files,
///   whatever their type.
/// - Any other word stands for itself, whether the file exists or not.
/// Hidden files and folders are left out. A file in folders or patterns is listed once, however often it is
/// found.
/// errors: no_source if a folder or pattern has none, input_missing if a folder cannot be read.
Result<std::vector<std::string>> expandSources(const std::vector<std::string>& words);

/// Return the folders that expandSources() searches: a new file in one of them may be another source. The
/// folder of a pattern may not exist yet.
std::vector<std::string> sourceFolders(const std::vector<std::string>& words);

/// Return every file in and below the folders among the words, models or not, each once and sorted by path,
/// without hidden ones. A folder that cannot be read has none.
std::vector<std::string> filesInFolders(const std::vector<std::string>& words);

} // namespace hearth::command
