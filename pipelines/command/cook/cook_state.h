// State that a cook has of previous cooks: the cache, the hashes of files, and the journal of the last cook
// into the same pack.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include "pipelines/cache/cache.h"
#include "pipelines/cache/cache_spec.h"
#include "pipelines/cache/directory_store.h"
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

/// Caches, hashes of files and journal of the cooks into one pack.
class CookState
{
public:
    /// Open the caches, and the state of cooks into a pack.
    /// output  path of the pack
    /// folder  base of the sources' relative paths
    /// warn    receives the errors of a cache
    static std::unique_ptr<CookState> openSpecs(const std::vector<cache::CacheSpec>& caches,
                                                const std::string& output, const std::string& folder,
                                                const std::function<void(const Error&)>& warn);

    /// Same, from values of --cache.
    /// caches  values of --cache; see cache::resolveCacheSpecs
    /// errors: usage
    static Result<std::unique_ptr<CookState>> open(const std::vector<std::string>& caches,
                                                   const std::string& output, const std::string& folder,
                                                   const std::function<void(const Error&)>& warn);

    cache::Cache& cache() { return *cache_; }
    graph::ActionCache& actions() { return *actions_; }
    graph::FileHashes& hashes() { return hashes_; }

    /// Prefetch: when a cache server has to be asked for the first time, ask it at once for everything that
    /// the graph will ask for. `graph` must stay alive.
    void enablePrefetch(const graph::Graph& graph);

    /// Return the journal of the last cook, which is read at the first call.
    const std::optional<graph::Journal>& journal();
    /// Store the journal of this cook instead.
    void write(const graph::Journal& journal);

    /// Store the hashes of files, and keep the caches within their limits.
    void finish();

private:
    explicit CookState(const std::string& folder) : hashes_(folder) {}

    std::vector<std::pair<const cache::DirectoryStore*, uint64_t>> folders_; ///< with their limits in bytes
    std::unique_ptr<cache::Cache> cache_;
    graph::FileHashes hashes_;
    std::unique_ptr<graph::ActionCache> actions_;
    std::string journal_path_; ///< without its extension; empty: no cache is writable
    bool journal_is_read_ = false;
    std::optional<graph::Journal> journal_;
};

/// Return the journals of all packs that the caches have, sorted by output.
std::vector<graph::Journal> readAllJournals(const std::vector<cache::CacheSpec>& caches);

} // namespace hearth::command
