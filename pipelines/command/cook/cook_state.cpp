// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/command/cook/cook_state.h"

#include "cook/tools/child_processes.h"
#include "formats/base/atomic_file.h"
#include "pipelines/cache/http_level.h"
#include "pipelines/cache/upkeep.h"
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

std::unique_ptr<CookMemory> CookMemory::over(const std::vector<cache::LevelSpec>& caches,
                                             const std::string& output, const std::string& folder,
                                             const std::function<void(const Error&)>& warn)
{
    std::unique_ptr<CookMemory> memory(new CookMemory(folder));
    std::vector<std::unique_ptr<cache::Level>> levels;
    for (const cache::LevelSpec& spec : caches)
    {
        if (spec.is_server)
        {
            levels.push_back(std::make_unique<cache::HttpLevel>(spec.place, spec.writable));
            continue;
        }
        auto level = std::make_unique<cache::FolderLevel>(graph::absolutePath(spec.place), spec.writable);
        if (spec.writable && memory->journal_path_.empty())
            memory->journal_path_ = graph::journalPath(level->name(), output);
        memory->folders_.emplace_back(level.get(), spec.limit_bytes);
        levels.push_back(std::move(level));
    }
    memory->cache_ = std::make_unique<cache::Cache>(std::move(levels), warn);
    if (!memory->journal_path_.empty())
        memory->hashes_.load(memory->journal_path_ + kHashesEnding);
    memory->actions_ =
        std::make_unique<graph::ActionCache>(*memory->cache_, memory->hashes_, tools::programFolder());
    return memory;
}

Result<std::unique_ptr<CookMemory>> CookMemory::open(const std::vector<std::string>& caches,
                                                     const std::string& output, const std::string& folder,
                                                     const std::function<void(const Error&)>& warn)
{
    HEARTH_ASSIGN_OR_RETURN(const std::vector<cache::LevelSpec> levels, cache::cacheSpecs(caches));
    return over(levels, output, folder, warn);
}

void CookMemory::expect(const graph::Graph& graph)
{
    cache_->beforeFarIsAsked([this, &graph] { graph::askAhead(graph, *cache_, *actions_); });
}

const std::optional<graph::Journal>& CookMemory::journal()
{
    if (!journal_is_read_ && !journal_path_.empty())
        if (const std::optional<std::string> text = cache::readText(journal_path_ + kJournalEnding))
            journal_ = graph::parseJournal(*text);
    journal_is_read_ = true;
    return journal_;
}

void CookMemory::write(const graph::Journal& journal)
{
    // if it cannot be written, only explanations of the next cook are lost
    std::error_code error;
    if (journal_path_.empty())
        return;
    std::filesystem::create_directories(std::filesystem::path(journal_path_).parent_path(), error);
    static_cast<void>(writeText(journal_path_ + kJournalEnding, graph::journalText(journal)).ok());
}

void CookMemory::finish()
{
    if (!journal_path_.empty())
        hashes_.save(journal_path_ + kHashesEnding);
    for (const auto& [level, limit_bytes] : folders_)
        if (level->isWritable())
            cache::noteAdded(level->name(), level->bytesAdded(), limit_bytes);
}

std::vector<graph::Journal> allJournals(const std::vector<cache::LevelSpec>& caches)
{
    std::vector<graph::Journal> journals;
    for (const cache::LevelSpec& spec : caches)
    {
        if (spec.is_server)
            continue;
        std::error_code error;
        for (auto at = std::filesystem::directory_iterator(spec.place + "/cooks", error);
             !error && at != std::filesystem::directory_iterator(); at.increment(error))
            if (const auto text = at->path().extension() == kJournalEnding
                                      ? cache::readText(at->path().string())
                                      : std::nullopt)
                if (auto journal = graph::parseJournal(*text))
                    journals.push_back(std::move(*journal));
    }
    std::sort(journals.begin(), journals.end(),
              [](const graph::Journal& a, const graph::Journal& b) { return a.output < b.output; });
    return journals;
}

} // namespace hearth::command
