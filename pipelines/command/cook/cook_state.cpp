// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cook_state.h"

#include "cook/tools/child_processes.h"
#include "formats/base/atomic_file.h"
#include "formats/base/regular_file.h"
#include "pipelines/cache/http_store.h"
#include "pipelines/cache/maintenance.h"
#include "pipelines/graph/prefetch.h"

#include <algorithm>
#include <filesystem>

namespace hearth::command
{

namespace
{

constexpr const char* kJournalEnding = ".cook";
constexpr const char* kHashesEnding = ".hashes";

} // namespace

std::unique_ptr<CookState> CookState::openSpecs(const std::vector<cache::CacheSpec>& caches,
                                                const std::string& output, const std::string& folder,
                                                const std::function<void(const Error&)>& warn)
{
    std::unique_ptr<CookState> state(new CookState(folder));
    std::vector<std::unique_ptr<cache::CacheLevel>> levels;
    for (const cache::CacheSpec& spec : caches)
    {
        if (spec.is_server)
        {
            levels.push_back(std::make_unique<cache::HttpStore>(spec.place, spec.writable));
            continue;
        }
        auto level = std::make_unique<cache::DirectoryStore>(graph::absolutePath(spec.place), spec.writable);
        if (spec.writable && state->journal_path_.empty())
            state->journal_path_ = graph::journalPath(level->name(), output);
        state->folders_.emplace_back(level.get(), spec.limit_bytes);
        levels.push_back(std::move(level));
    }
    state->cache_ = std::make_unique<cache::Cache>(std::move(levels), warn);
    if (!state->journal_path_.empty())
        state->hashes_.load(state->journal_path_ + kHashesEnding);
    state->actions_ =
        std::make_unique<graph::ActionCache>(*state->cache_, state->hashes_, tools::programFolder());
    return state;
}

Result<std::unique_ptr<CookState>> CookState::open(const std::vector<std::string>& caches,
                                                   const std::string& output, const std::string& folder,
                                                   const std::function<void(const Error&)>& warn)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<cache::CacheSpec> levels, cache::resolveCacheSpecs(caches));
    return openSpecs(levels, output, folder, warn);
}

void CookState::enablePrefetch(const graph::Graph& graph)
{
    cache_->beforeRemoteLookup([this, &graph] { graph::prefetch(graph, *cache_, *actions_); });
}

const std::optional<graph::Journal>& CookState::journal()
{
    if (!journal_is_read_ && !journal_path_.empty())
        if (const Result<std::string> text = readFile(journal_path_ + kJournalEnding); text.ok())
            journal_ = graph::parseJournal(*text);
    journal_is_read_ = true;
    return journal_;
}

void CookState::write(const graph::Journal& journal)
{
    // if it cannot be written, only explanations of the next cook are lost
    std::error_code error;
    if (journal_path_.empty())
        return;
    std::filesystem::create_directories(std::filesystem::path(journal_path_).parent_path(), error);
    static_cast<void>(writeText(journal_path_ + kJournalEnding, graph::journalText(journal)).ok());
}

void CookState::finish()
{
    if (!journal_path_.empty())
        hashes_.save(journal_path_ + kHashesEnding);
    for (const auto& [level, limit_bytes] : folders_)
        if (level->isWritable())
            cache::recordGrowth(level->name(), level->bytesAdded(), limit_bytes);
}

std::vector<graph::Journal> readAllJournals(const std::vector<cache::CacheSpec>& caches)
{
    std::vector<graph::Journal> journals;
    for (const cache::CacheSpec& spec : caches)
    {
        if (spec.is_server)
            continue;
        std::error_code error;
        for (auto at = std::filesystem::directory_iterator(spec.place + "/cooks", error);
             !error && at != std::filesystem::directory_iterator(); at.increment(error))
        {
            if (at->path().extension() != kJournalEnding)
                continue;
            const Result<std::string> text = readFile(at->path().string());
            if (auto journal = text ? graph::parseJournal(*text) : std::nullopt)
                journals.push_back(std::move(*journal));
        }
    }
    std::sort(journals.begin(), journals.end(),
              [](const graph::Journal& a, const graph::Journal& b) { return a.output < b.output; });
    return journals;
}

} // namespace hearth::command
