// Action cache: stores results of actions, and finds them by the files that an action would read now.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "cook/tools/dependency_list.h"
#include "pipelines/cache/cache.h"
#include "pipelines/graph/action_record.h"
#include "pipelines/graph/file_hashes.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace hearth::graph
{

struct CachedOutput
{
    std::string hash;
    uint64_t bytes = 0;
};

/// Cached result of an action, with its warnings and resource use.
struct CachedResult
{
    std::vector<CachedOutput> outputs; ///< in the order of the action's outputs
    std::vector<std::string> warnings; ///< lines, with paths as the user typed them
    double seconds = 0;
    double cpu_seconds = 0;
    uint64_t peak_rss_bytes = 0;
    /// Text of the first output of an action that writes a list. It is stored with the result, so that a
    /// cook that runs nothing need not fetch it.
    std::string list{};
};

/// SHA-256 of the outputs of each action; empty for an action whose outputs are not known yet.
using OutputHashes = std::vector<std::vector<std::string>>;

std::vector<std::string> listHashes(const CachedResult& result);

/// Return for each input SHA-256 of the output that it is, "" for user files; nullopt where one is not known
/// yet.
std::optional<std::vector<std::string>> findPartHashes(const Action& action, const OutputHashes& hashes);

class ActionCache
{
public:
    ActionCache(cache::Cache& cache, FileHashes& hashes, std::string programs)
        : cache_(cache), hashes_(hashes), programs_(std::move(programs))
    {
    }

    /// Return the record of an action without found files; nullopt where a user file or the cooker cannot be
    /// read, so that no result can be cached.
    /// part_hashes  for each input, SHA-256 of the output that it is; empty for user files
    std::optional<Record> makeRecord(const Action& action, const std::vector<std::string>& part_hashes);

    struct LookupResult
    {
        Record record; ///< with found files, where they are known
        std::optional<CachedResult> result;
        bool is_damaged = false; ///< the cache had a result, but a damaged one
    };
    LookupResult find(const Action& action, const Record& record);
    /// Return the record of an action that finds files, with the hashes of these files now; nullopt where no
    /// list of found files holds.
    std::optional<Record> recordFromFindings(const Action& action, const Record& record);

    /// Return the record with the files that the action has found; nullopt where the result cannot be cached,
    /// because a file has changed meanwhile.
    std::optional<Record> recordFromReads(const Action& action, const Record& record,
                                          const tools::DependencyList& reads);
    /// Store a result.
    /// record  from recordFromReads, or from makeRecord for an action that finds no files
    void store(const Action& action, const Record& record, const CachedResult& result);

    /// Return the record with the current hashes of its found files.
    Record withCurrentHashes(const Action& action, const Record& record);

    /// Return the paths of the found files of a record, including files that were missing.
    std::vector<std::string> probedFiles(const Action& action, const Record& record);

private:
    std::optional<Record> completeRecord(const Action& action, const Record& record,
                                         const cache::Fields& findings);
    std::string versionOfCooker(const std::string& cooker);
    std::string resolveFolder(const std::string& path);
    std::string foundFilePath(const Action& action, const std::string& found);
    std::string currentHash(const Action& action, const std::string& found);

    cache::Cache& cache_;
    FileHashes& hashes_;
    std::string programs_;
    std::map<std::string, std::string> version_of_cooker_;
    std::map<std::string, std::string> real_folder_of_path_;
};

} // namespace hearth::graph
