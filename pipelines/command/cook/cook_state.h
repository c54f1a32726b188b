// What a cook knows of cooks before it: the cache, the hashes of files, and how the last cook into the same pack went.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache.h"
#include "pipelines/cache/directory_store.h"
#include "pipelines/cache/open_cache.h"
#include "pipelines/graph/action_cache.h"
#include "pipelines/graph/file_hashes.h"
#include "pipelines/graph/journal.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace hearth::command
{

class CookMemory
{
public:
    /// output    the pack
    /// folder    that relative paths of sources start from
    /// warn      is told what goes wrong with a cache
    static std::unique_ptr<CookMemory> over(const std::vector<cache::LevelSpec>& caches,
                                            const std::string& output, const std::string& folder,
                                            const std::function<void(const Error&)>& warn);

    /// The same of what was typed.
    /// caches    of --cache; see cache::cacheSpecs
    /// errors    usage
    static Result<std::unique_ptr<CookMemory>> open(const std::vector<std::string>& caches,
                                                    const std::string& output, const std::string& folder,
                                                    const std::function<void(const Error&)>& warn);

    cache::Cache& cache() { return *cache_; }
    graph::ActionCache& actions() { return *actions_; }
    graph::FileHashes& hashes() { return hashes_; }

    /// Where a cache on a server has to be asked, ask at once for all that the graph will ask for. The graph stays.
    void expect(const graph::Graph& graph);

    /// Of the last cook; read when it is first asked for.
    const std::optional<graph::Journal>& journal();
    /// Remember this cook instead.
    void write(const graph::Journal& journal);

    /// Remember the hashes of files, and keep the caches within their limits.
    void finish();

private:
    explicit CookMemory(const std::string& folder) : hashes_(folder) {}

    std::vector<std::pair<const cache::FolderLevel*, uint64_t>> folders_; ///< and how much they may hold
    std::unique_ptr<cache::Cache> cache_;
    graph::FileHashes hashes_;
    std::unique_ptr<graph::ActionCache> actions_;
    std::string journal_path_; ///< without its ending; empty: no cache may be written
    bool journal_is_read_ = false;
    std::optional<graph::Journal> journal_;
};

/// The journals of all packs that the caches know of.
std::vector<graph::Journal> allJournals(const std::vector<cache::LevelSpec>& caches);

} // namespace hearth::command
