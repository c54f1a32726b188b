// Results of actions in a cache: found by what an action would read now, kept with what it has read.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/read_list.h"
#include "pipelines/cache/cache.h"
#include "pipelines/graph/action_record.h"
#include "pipelines/graph/file_hashes.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

struct KeptOutput
{
    std::string hash;
    uint64_t bytes = 0;
};

/// What an action made, and how that went.
struct KeptResult
{
    std::vector<KeptOutput> outputs;   ///< in the order of the action's
    std::vector<std::string> warnings; ///< lines, in words of the user
    double seconds = 0;
    double cpu_seconds = 0;
    uint64_t peak_rss_bytes = 0;
};

class ActionCache
{
public:
    ActionCache(cache::Cache& cache, FileHashes& hashes, std::string programs)
        : cache_(cache), hashes_(hashes), programs_(std::move(programs))
    {
    }

    /// The record of an action without what it finds by itself; nullopt where a file of the user or the cooker cannot be
    /// read, so that nothing can be kept.
    /// part_hashes  of the first outputs of the actions that it reads, by input; what is the user's is empty
    std::optional<Record> recordOf(const Action& action, const std::vector<std::string>& part_hashes);

    struct Found
    {
        Record record; ///< with what the action finds, where that is known
        std::optional<KeptResult> result;
        bool is_damaged = false; ///< there was one, but not whole
    };
    Found find(const Action& action, const Record& record);
    /// Of an action that finds files: its record with what it finds now, as far as that is known; nullopt where it is not.
    std::optional<Record> recordByFindings(const Action& action, const Record& record);

    /// The record with what the action has found; nullopt where it cannot be kept, because a file has changed meanwhile.
    std::optional<Record> recordAfter(const Action& action, const Record& record,
                                      const tools::ReadList& reads);
    /// record  as recordAfter gives it, or recordOf for an action that finds no files
    void keep(const Action& action, const Record& record, const KeptResult& result);

    /// What the files are now that a record of before says were found.
    Record refreshed(const Action& action, const Record& record);

    /// Paths of the files that a record of the action says were found, or looked for in vain.
    std::vector<std::string> filesLookedFor(const Action& action, const Record& record);

private:
    std::optional<Record> wholeRecord(const Action& action, const Record& record,
                                      const cache::Fields& findings);
    std::string versionOf(const std::string& cooker);
    std::string realFolderOf(const std::string& path);
    std::string pathOfFound(const Action& action, const std::string& found);
    std::string hashNow(const Action& action, const std::string& found);

    cache::Cache& cache_;
    FileHashes& hashes_;
    std::string programs_;
    std::map<std::string, std::string> version_of_cooker_;
    std::map<std::string, std::string> real_folder_of_path_;
};

} // namespace hearth::graph
