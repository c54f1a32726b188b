// What is remembered of the last cook into a pack, so that the next one can say why it runs what it runs.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/graph/action.h"
#include "pipelines/graph/action_record.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hearth::graph
{

/// What became of an action.
enum class Ending
{
    unknown,  ///< the cook ended before
    cooked,   ///< it has run
    kept,     ///< its result was in the cache
    failed,   ///< its cooker failed
    left_out, ///< what it reads from failed
};

struct JournalAction
{
    Ending ending = Ending::unknown;
    std::vector<std::string> causes; ///< why it ran
    Record record;                   ///< empty where an input could not be read
};

struct Journal
{
    std::string folder;       ///< that relative paths start from
    std::string output;       ///< absolute
    std::string output_cause; ///< why the pack was put in its place; empty where it was not
    Graph graph;
    std::vector<JournalAction> actions; ///< of the graph
};

std::string journalText(const Journal& journal);
/// nullopt where the text is damaged or of another version
std::optional<Journal> parseJournal(std::string_view text);

/// The file for a pack in a cache's folder, without its ending: <folder>/cooks/SHA256 of the absolute path.
std::string journalPath(const std::string& cache_folder, const std::string& output);

/// The path from the root, through the working folder; links stay.
std::string absolutePath(const std::string& path);
std::string workingFolder();

} // namespace hearth::graph
