// Journal of the last cook into a pack, from which the next cook explains why actions run.
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

/// Outcome of an action.
enum class Outcome
{
    unknown, ///< the cook ended before it ran
    cooked,  ///< its cooker ran
    cached,  ///< cache hit
    failed,  ///< its cooker failed
    skipped, ///< skipped: an action that it depends on failed
};

struct JournalAction
{
    Outcome ending = Outcome::unknown;
    std::vector<std::string> causes; ///< reasons why it ran
    Record record;                   ///< empty where an input could not be read
};

struct Journal
{
    std::string folder;       ///< working folder, the base of relative paths
    std::string output;       ///< absolute
    std::string output_cause; ///< reason why the pack was replaced; empty where it was not
    Graph graph;
    std::vector<JournalAction> actions; ///< [graph.actions.size()]
};

std::string journalText(const Journal& journal);
/// Parse a journal; nullopt where the text is damaged or of another version.
std::optional<Journal> parseJournal(std::string_view text);

/// Return the path of a pack's journal in a cache's folder, without extension: <folder>/cooks/SHA256 of the
/// pack's absolute path.
std::string journalPath(const std::string& cache_folder, const std::string& output);

/// Return the path from the root, by way of the working folder; links are not resolved.
std::string absolutePath(const std::string& path);
std::string workingFolder();

} // namespace hearth::graph
