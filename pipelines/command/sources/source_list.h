// What people type as sources: files, folders, patterns.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "formats/base/result.h"

#include <string>
#include <vector>

namespace hearth::command
{

/// Whether the name's ending is that of a model: glTF, GLB, OBJ, PLY, STL, OFF or Draco.
bool isModel(const std::string& path);

/// The files that words stand for, in their order. A folder stands for all models in it and below, sorted by path: glTF, GLB,
/// OBJ, PLY, STL, OFF and Draco files; images are what models refer to, and lie there too. A pattern ("props/**/*.glb"; it must
/// be quoted, or the shell takes it) stands for the files that match, whatever their kind. Hidden files and folders are left out.
/// Another word stands for itself, whether such a file is there or not. What a folder or pattern has is there once, however often it is found.
/// errors: no_source where a folder or pattern has none, input_missing where a folder cannot be read.
Result<std::vector<std::string>> sourcesOf(const std::vector<std::string>& words);

/// The folders in which sourcesOf() has looked for files: another file in one of them may be another source. A pattern's
/// may not be there yet.
std::vector<std::string> foldersOf(const std::vector<std::string>& words);

/// Every file of the folders among the words, and below, models or not, each once and sorted by path; as
/// sourcesOf() without hidden ones. A folder that cannot be read has none.
std::vector<std::string> filesOfFolders(const std::vector<std::string>& words);

} // namespace hearth::command
