// Tests remote cache levels: requests, their number, and the use of the answers.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/sha256.h"
#include "pipelines/cache/directory_store.h"
#include "pipelines/graph/cook_graph.h"
#include "pipelines/graph/prefetch.h"
#include "pipelines/graph/resolver.h"
#include "tests/support/sandbox.h"

#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::graph
{

namespace
{

using cache::Cache;
using cache::Fields;
using test::Sandbox;
using tools::computeSha256;

struct Asked
{
    size_t rounds = 0;  ///< round trips
    size_t entries = 0; ///< requested entries
    size_t puts = 0;
};

/// Directory that counts requests, as a server could.
class FarLevel : public cache::DirectoryStore
{
public:
    FarLevel(const std::string& folder, Asked& asked) : DirectoryStore(folder, true), asked_(asked) {}
    bool isRemote() const override { return true; }
    Status entries(std::span<cache::EntryRequest> wanted) override
    {
        ++asked_.rounds;
        asked_.entries += wanted.size();
        return DirectoryStore::entries(wanted);
    }
    Status putEntry(const std::string& key, const std::string& text) override
    {
        ++asked_.puts;
        return DirectoryStore::putEntry(key, text);
    }

private:
    Asked& asked_;
};

constexpr size_t kSources = 20;

class FarCache : public ::testing::Test
{
protected:
    FarCache()
    {
        CookSettings settings;
        settings.output = folder / "a.hearth";
        settings.values_of_source.assign(kSources, {{"visibility.mode", {"\"off\"", ""}}});
        settings.values_of_pack = {{"bricks.mode", {"\"off\"", ""}}};
        for (size_t i = 0; i < kSources; ++i)
        {
            folder.write(std::to_string(i) + ".obj", std::to_string(i));
            settings.sources.push_back(folder / (std::to_string(i) + ".obj"));
        }
        for (const char* cooker : {"import", "textures", "texels", "clusters", "skinning", "link"})
            folder.write(std::string("hearth-") + cooker, cooker, true);
        graph = makeCookGraph(settings).value();
    }

    /// Return a cache over folders of the sandbox, by their names; the folder called "far" is remote.
    Cache open(const std::vector<std::string>& names)
    {
        std::vector<std::unique_ptr<cache::CacheLevel>> levels;
        for (const std::string& name : names)
            if (name == "far")
                levels.push_back(std::make_unique<FarLevel>(folder / name, asked));
            else
                levels.push_back(std::make_unique<cache::DirectoryStore>(folder / name, true));
        return Cache(std::move(levels),
                     [this](const Error& error) { warnings.push_back(formatMessage(error)); });
    }

    /// Store a result of every action, as if it had run; imports have read wood.png.
    void keepAll(Cache& cache)
    {
        FileHashes hashes("/");
        ActionCache actions(cache, hashes, folder.path());
        std::vector<std::string> hash_of_action;
        for (const Action& action : graph.actions)
        {
            std::vector<std::string> part_hashes;
            for (const Input& input : action.inputs)
                part_hashes.push_back(input.action == kNoAction ? "" : hash_of_action[input.action]);
            Record record = *actions.makeRecord(action, part_hashes);
            if (action.finds_files)
            {
                tools::DependencyList reads;
                reads.addFile(folder / "wood.png");
                record = *actions.recordFromReads(action, record, reads);
            }
            hash_of_action.push_back(resultKey(record));
            std::vector<CachedOutput> outputs(action.outputs.size(), {hash_of_action.back(), 1});
            actions.store(action, record, {outputs, {}, 1, 1, 1});
        }
    }

    /// Return the number of actions that would run.
    size_t runs(Cache& cache)
    {
        FileHashes hashes("/");
        ActionCache actions(cache, hashes, folder.path());
        const std::optional<Journal> none;
        Resolver resolver(
            graph, &cache, &actions, [&]() -> const std::optional<Journal>& { return none; }, false);
        cache.beforeRemoteLookup([&] { prefetch(graph, cache, actions); });
        size_t count = 0;
        for (const Forecast::Entry& entry : forecast(graph, resolver).actions)
            count += entry.runs ? 1 : 0;
        return count;
    }

    Sandbox folder;
    Graph graph;
    Asked asked;
    std::vector<std::string> warnings;
};

} // namespace

TEST_F(FarCache, isAskedInWavesNotActionByAction)
{
    Cache writer = open({"far"});
    keepAll(writer);
    asked = {};
    Cache cold = open({"near", "far"});
    EXPECT_EQ(runs(cold), 0u);
    // rounds: files found by imports, outputs of imports, outputs made from them, bounds of clusters, pack
    EXPECT_LE(asked.rounds, 6u);
    EXPECT_EQ(asked.entries, graph.actions.size() + kSources) << "each entry once";
    asked = {};
    Cache warm = open({"near", "far"});
    EXPECT_EQ(runs(warm), 0u);
    EXPECT_EQ(asked.rounds, 0u) << "near has it all";
}

TEST_F(FarCache, isNotAskedForWhatCannotBeThere)
{
    Cache cache = open({"near", "far"});
    EXPECT_EQ(runs(cache), graph.actions.size());
    EXPECT_EQ(asked.rounds, 1u);
    EXPECT_EQ(asked.entries, kSources) << "what is behind an import that must run has no key";
}

TEST_F(FarCache, sourcesThatFoundOtherFilesAreFoundInAllLevels)
{
    const auto runsWith = [&](const std::string& wood, const std::vector<std::string>& levels)
    {
        folder.write("wood.png", wood);
        Cache cache = open(levels);
        return runs(cache);
    };
    const auto keepWith = [&](const std::string& wood, const std::vector<std::string>& levels)
    {
        folder.write("wood.png", wood);
        Cache cache = open(levels);
        keepAll(cache);
    };
    keepWith("oak", {"mine", "far"});
    keepWith("ash", {"theirs", "far"});
    EXPECT_EQ(runsWith("ash", {"mine", "far"}), 0u) << "mine knows oak only";
    EXPECT_EQ(runsWith("oak", {"theirs", "far"}), 0u) << "and theirs ash";
    for (const char* near : {"mine", "theirs"})
        for (const char* wood : {"oak", "ash"})
        {
            asked = {};
            EXPECT_EQ(runsWith(wood, {near, "far"}), 0u);
            EXPECT_EQ(asked.rounds, 0u) << near << " has learned " << wood;
        }
    keepWith("elm", {"mine", "far"});
    EXPECT_EQ(runsWith("ash", {"far"}), 0u) << "what others found is still in the list";
}

TEST_F(FarCache, thatAnswersWithGarbageIsReadNoMoreButMended)
{
    {
        Cache writer = open({"far"});
        keepAll(writer);
    }
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder / "far/ac"))
        if (file.is_regular_file())
            folder.write("far/ac/" + file.path().parent_path().filename().string() + "/" +
                             file.path().filename().string(),
                         "<html>Please log in</html>");
    Cache cache = open({"near", "far"});
    EXPECT_EQ(runs(cache), graph.actions.size());
    ASSERT_GE(warnings.size(), 2u);
    EXPECT_LE(warnings.size(), 8u) << "not one for each of the " << graph.actions.size();
    EXPECT_NE(warnings.back().find("no more is taken from there"), std::string::npos) << warnings.back();
    keepAll(cache);
    warnings.clear();
    Cache mended = open({"far"});
    EXPECT_EQ(runs(mended), 0u);
    EXPECT_EQ(warnings, std::vector<std::string>{});
}

TEST_F(FarCache, thatFailsIsToldOfOnce)
{
    folder.write("far", "a file, where a folder should be");
    Cache cache = open({"near", "far"});
    keepAll(cache);
    EXPECT_EQ(warnings.size(), 1u);
    EXPECT_EQ(asked.puts, 1u);
    EXPECT_EQ(runs(cache), 0u);
}

} // namespace hearth::graph
