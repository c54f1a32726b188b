// Tests cache keys: a change that affects the bytes of a part changes its key, and nothing else does.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/tools/sha256.h"
#include "pipelines/cache/directory_store.h"
#include "pipelines/cookers/registry.h"
#include "pipelines/graph/action_cache.h"
#include "pipelines/graph/cook_graph.h"
#include "pipelines/graph/cooker_version.h"
#include "pipelines/graph/shared_libraries.h"
#include "tests/support/sandbox.h"

#include <algorithm>
#include <chrono>
#include <clocale>
#include <filesystem>
#include <functional>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <sys/stat.h>
#include <thread>
#include <tuple>

namespace hearth::graph
{

namespace
{

namespace fs = std::filesystem;
using test::Sandbox;

/// Return one of two values that differ; flags are true, then false.
settings::Value chooseValue(const settings::Setting& setting, size_t which)
{
    using settings::Kind;
    switch (setting.kind)
    {
    case Kind::flag:
        return {which == 0 ? "true" : "false", ""};
    case Kind::choice:
        return {"\"" + std::string(setting.choices[which]) + "\"", ""};
    case Kind::whole:
        return {setting.choices.empty() ? std::to_string(which + 3) : std::string(setting.choices[which]),
                ""};
    case Kind::number:
    case Kind::size:
        return {std::to_string(which + 1), ""};
    case Kind::text:
    case Kind::texts:
        return {which == 0 ? "[\"a\"]" : "[\"b\"]", ""};
    case Kind::tables:
        return {which == 0 ? "[{keep=0.5}]" : "[{keep=0.6}]", ""};
    }
    return {};
}

/// Folder with sources and cookers, and the keys of everything that is cooked in it.
class Keys : public ::testing::Test
{
protected:
    Keys() { fill(folder); }

    static void fill(const Sandbox& sandbox)
    {
        for (const char* name : {"a.obj", "low.obj", "wood.png", "sky.hdr"})
            sandbox.write(name, name);
        for (const cookers::Cooker& cooker : cookers::allCookers())
            sandbox.write("hearth-" + std::string(cooker.name), std::string(cooker.name), true);
    }

    static CookSettings settingsIn(const Sandbox& sandbox)
    {
        CookSettings settings;
        settings.sources = {sandbox / "a.obj"};
        settings.output = sandbox / "a.hearth";
        settings.lods_of_source = {{"1=" + sandbox / "low.obj"}};
        settings.values_of_source.resize(1);
        for (const cookers::Cooker& cooker : cookers::allCookers())
            for (const settings::Setting& setting : cooker.settings)
                (cooker.scope == settings::Scope::source ? settings.values_of_source[0]
                                                         : settings.values_of_pack)[setting.key] =
                    chooseValue(setting, 0);
        settings.values_of_pack["environment.file"].text = "\"" + sandbox / "sky.hdr" + "\"";
        settings.values_of_source[0]["proxy.from"].text = "\"wrap\"";
        return settings;
    }

    /// Return the key of each action by its cooker, taking a part's key for its content. The import has found
    /// wood.png and missed stone.png.
    static std::map<std::string, std::string> keysIn(const Sandbox& sandbox, const CookSettings& settings)
    {
        cache::Cache cache({}, [](const Error&) {});
        FileHashes hashes("/");
        ActionCache actions(cache, hashes, sandbox.path());
        const Graph graph = makeCookGraph(settings).value();
        std::map<std::string, std::string> keys;
        std::vector<std::string> parts;
        for (const Action& action : graph.actions)
        {
            std::vector<std::string> part_hashes;
            for (const Input& input : action.inputs)
                part_hashes.push_back(input.action == kNoAction ? "" : parts[input.action]);
            std::optional<Record> record = actions.makeRecord(action, part_hashes);
            if (record && action.finds_files)
            {
                tools::DependencyList reads;
                reads.addFile(sandbox / "wood.png");
                reads.addFile(sandbox / "stone.png");
                record = actions.recordFromReads(action, *record, reads);
            }
            parts.push_back(record ? resultKey(*record) : "none");
            keys[action.cooker] = parts.back();
        }
        return keys;
    }

    std::map<std::string, std::string> keys(const CookSettings& settings) { return keysIn(folder, settings); }

    /// Return the cookers whose keys differ, sorted by name.
    static std::set<std::string> changed(const std::map<std::string, std::string>& before,
                                         const std::map<std::string, std::string>& after)
    {
        std::set<std::string> cookers;
        for (const auto& [cooker, key] : after)
            if (const auto old = before.find(cooker); old == before.end() || old->second != key)
                cookers.insert(cooker);
        for (const auto& [cooker, key] : before)
            if (!after.contains(cooker))
                cookers.insert(cooker);
        return cookers;
    }

    Sandbox folder;
};

const std::set<std::string> kOfSource{"import",      "textures", "estimates",  "budget", "texels",
                                      "clusters",    "skinning", "visibility", "bricks", "receivers",
                                      "reflections", "link",     "wrap",       "proxy"};

} // namespace

TEST_F(Keys, everyParameterChangesThem)
{
    const CookSettings settings = settingsIn(folder);
    // if this line no longer compiles because a parameter was added, add a row for it below
    const auto& [sources, output, lods, of_source, of_pack] = settings;
    static_cast<void>(std::tie(sources, output, lods, of_source, of_pack));

    struct Row
    {
        const char* what;
        std::function<void(CookSettings&)> change;
        std::set<std::string> cookers;
    };
    const std::string low = folder / "low.obj";
    const std::vector<Row> rows{
        {"another source", [&](CookSettings& s) { s.sources = {low}; }, kOfSource},
        {"a source more",
         [&](CookSettings& s)
         {
             s.sources.push_back(low);
             s.values_of_source.push_back(s.values_of_source[0]);
             s.lods_of_source.emplace_back();
         },
         {"import", "textures", "estimates", "budget", "texels", "clusters", "skinning", "neighbours",
          "visibility", "bricks", "receivers", "reflections", "wrap", "proxy", "link"}},
        {"no lod", [](CookSettings& s) { s.lods_of_source.clear(); }, kOfSource},
        {"another level", [&](CookSettings& s) { s.lods_of_source = {{"2=" + low}}; }, kOfSource},
        {"another lod", [&](CookSettings& s) { s.lods_of_source = {{"1=" + s.sources[0]}}; }, kOfSource},
        {"the output's name", [&](CookSettings& s) { s.output = folder / "b.hearth"; }, {}},
    };
    const auto before = keys(settings);
    for (const Row& row : rows)
    {
        CookSettings other = settings;
        row.change(other);
        EXPECT_EQ(changed(before, keys(other)), row.cookers) << row.what;
    }
}

TEST_F(Keys, everySettingChangesThoseOfItsCookerAndItsReaders)
{
    const CookSettings settings = settingsIn(folder);
    const auto before = keys(settings);
    const std::map<std::string, std::set<std::string>> readers{
        {"import", kOfSource},
        {"wrap", {"wrap", "proxy", "bricks", "receivers", "link"}},
        {"proxy", {"proxy", "bricks", "receivers", "link"}},
        {"clusters",
         {"clusters", "skinning", "proxy", "visibility", "bricks", "receivers", "reflections", "link"}},
        {"textures",
         {"textures", "estimates", "budget", "texels", "bricks", "receivers", "reflections", "link"}},
        {"texels", {"estimates", "budget", "texels", "link"}},
        {"visibility", {"visibility", "link"}},
        {"probe", {"probe", "bricks", "receivers", "reflections", "link"}},
        {"bricks", {"bricks", "receivers", "link"}},
        {"receivers", {"receivers", "link"}},
        {"reflections", {"reflections", "link"}}};
    // settings that a cooker before theirs reads, too: import makes UVs for texels, and wraps are decimated
    const std::map<std::string, std::string> first_readers{
        {"receivers.texels_per_metre", "import"}, {"proxy.error", "wrap"}, {"proxy.triangles", "wrap"}};
    for (const cookers::Cooker& cooker : cookers::allCookers())
        for (const settings::Setting& setting : cooker.settings)
        {
            // the LODs are files, and the cookers that a flag enables are tested below
            if (setting.key == cookers::kImportLods || setting.key == cooker.switched_by)
                continue;
            const auto earlier = first_readers.find(setting.key);
            const std::set<std::string>& expected =
                readers.at(earlier == first_readers.end() ? std::string(cooker.name) : earlier->second);
            CookSettings other = settings;
            settings::Values& values =
                cooker.scope == settings::Scope::source ? other.values_of_source[0] : other.values_of_pack;
            values[setting.key] = chooseValue(setting, 1);
            EXPECT_EQ(changed(before, keys(other)), expected) << setting.key;
            // a power needs a distance
            if (setting.key == "visibility.distance")
                values.erase("visibility.power");
            values.erase(setting.key);
            // as before; bricks.inside makes no word of the command line, but says which parts it reads
            if (setting.default_text == chooseValue(setting, 0).text || setting.key == "bricks.inside")
                continue;
            EXPECT_EQ(changed(before, keys(other)), expected) << setting.key;
        }
}

TEST_F(Keys, flagsAddTheirCookers)
{
    const CookSettings settings = settingsIn(folder);
    const auto before = keys(settings);
    CookSettings other = settings;
    other.values_of_source[0]["visibility.mode"].text = "\"off\"";
    EXPECT_EQ(changed(before, keys(other)),
              (std::set<std::string>{"clusters", "skinning", "proxy", "visibility", "specular", "bricks",
                                     "receivers", "reflections", "link"}));
    other = settings;
    other.values_of_source[0]["proxy.from"].text = "\"clean\"";
    EXPECT_EQ(changed(before, keys(other)),
              (std::set<std::string>{"wrap", "proxy", "bricks", "receivers", "link"}));
    other.values_of_source[0]["proxy.from"].text = "\"authored\"";
    EXPECT_EQ(changed(before, keys(other)),
              (std::set<std::string>{"wrap", "proxy", "bricks", "receivers", "link"}));
    other.values_of_source[0]["proxy.from"].text = "\"source\"";
    other.values_of_source[0].erase("import.proxies");
    EXPECT_EQ(changed(before, keys(other)), kOfSource) << "import leaves them out";
    other = settings;
    other.values_of_pack["bricks.mode"].text = "\"off\"";
    EXPECT_EQ(changed(before, keys(other)), (std::set<std::string>{"bricks", "link", "receivers"}));
    other = settings;
    other.values_of_pack["receivers.mode"].text = "\"off\"";
    EXPECT_EQ(changed(before, keys(other)), kOfSource) << "import makes UVs for them";
    other = settings;
    other.values_of_pack["environment.file"].text = "\"off\"";
    std::set<std::string> with_probe = kOfSource;
    with_probe.insert("probe");
    EXPECT_EQ(changed(before, keys(other)), with_probe) << "import makes the sky in the size that is set";
    other.values_of_pack.erase("environment.sky_size");
    EXPECT_EQ(changed(before, keys(other)),
              (std::set<std::string>{"probe", "bricks", "receivers", "reflections", "link"}));
    other = settings;
    other.values_of_pack["reflections.probes"].text = "[]";
    EXPECT_EQ(changed(before, keys(other)), (std::set<std::string>{"reflections", "link"}));
    other = settings;
    other.values_of_pack.erase("textures.budget");
    EXPECT_EQ(changed(before, keys(other)), (std::set<std::string>{"estimates", "budget", "link"}));
}

TEST_F(Keys, everyFileChangesThem)
{
    const CookSettings settings = settingsIn(folder);
    for (const char* name : {"a.obj", "low.obj", "wood.png", "stone.png", "hearth-import"})
    {
        const auto before = keys(settings);
        folder.write(name, std::string("other ") + name);
        EXPECT_EQ(changed(before, keys(settings)), kOfSource) << name;
    }
    const auto before = keys(settings);
    folder.write("hearth-skinning", "another build", true);
    EXPECT_EQ(changed(before, keys(settings)), (std::set<std::string>{"skinning", "link"}));
    folder.write("hearth-skinning", "skinning", true);
    folder.write("sky.hdr", "another sky");
    EXPECT_EQ(changed(before, keys(settings)),
              (std::set<std::string>{"probe", "bricks", "receivers", "reflections", "link"}));
    fs::rename(folder / "wood.png", folder / "wool.png");
    folder.write("sky.hdr", "sky.hdr");
    EXPECT_EQ(changed(before, keys(settings)), kOfSource) << "a file that is gone";
}

TEST_F(Keys, aNameOfASourceIsInItsPart)
{
    CookSettings settings = settingsIn(folder);
    const auto before = keys(settings);
    fs::copy(folder / "a.obj", folder / "b.obj");
    settings.sources = {folder / "b.obj"};
    EXPECT_EQ(changed(before, keys(settings)), kOfSource);
}

TEST_F(Keys, nothingElseChangesThem)
{
    const CookSettings settings = settingsIn(folder);
    const auto before = keys(settings);
    // another folder, other times, another user's environment
    const mode_t mask = ::umask(077);
    const Sandbox elsewhere;
    fill(elsewhere);
    ::setenv("TZ", "Asia/Tokyo", 1);
    ::setenv("LC_ALL", "de_DE.UTF-8", 1);
    ::setenv("USER", "somebody", 1);
    std::setlocale(LC_ALL, "");
    fs::last_write_time(elsewhere / "a.obj", fs::file_time_type::clock::now() - std::chrono::hours(1000));
    EXPECT_EQ(keysIn(elsewhere, settingsIn(elsewhere)), before);
    std::setlocale(LC_ALL, "C");
    ::umask(mask);
    // through a link, and through an equivalent path
    CookSettings other = settings;
    fs::create_directory(folder / "sub");
    fs::create_symlink("../a.obj", folder / "sub/a.obj");
    other.sources = {folder / "sub/../sub/a.obj"};
    EXPECT_EQ(keys(other), before);
}

TEST_F(Keys, hideNoPaths)
{
    cache::Cache cache({}, [](const Error&) {});
    FileHashes hashes("/");
    ActionCache actions(cache, hashes, folder.path());
    const Graph graph = makeCookGraph(settingsIn(folder)).value();
    for (const Action& action : graph.actions)
        EXPECT_EQ(
            cache::formatFields(*actions.makeRecord(action, std::vector<std::string>(action.inputs.size())))
                .find(folder.path()),
            std::string::npos)
            << action.cooker;
}

TEST_F(Keys, whatCannotBeReadHasNone)
{
    CookSettings settings = settingsIn(folder);
    settings.lods_of_source = {{"1=" + folder / "missing.obj"}};
    EXPECT_EQ(keys(settings)["import"], "none");
    settings = settingsIn(folder);
    fs::remove(folder / "hearth-link");
    EXPECT_EQ(keys(settings)["link"], "none");
}

TEST_F(Keys, differentWordsAreDifferentRecords)
{
    // one word must differ from two, and a file from a text that looks like its name
    Action action;
    action.cooker = "x";
    action.outputs = {"out"};
    const auto makeKey = [&](std::vector<Word> words)
    {
        action.words = std::move(words);
        return resultKey(makeRecord(action, "v", {}));
    };
    const std::set<std::string> keys{makeKey({{Word::Kind::text, "a b", 0}}),
                                     makeKey({{Word::Kind::text, "a", 0}, {Word::Kind::text, "b", 0}}),
                                     makeKey({{Word::Kind::text, "a\tb", 0}}),
                                     makeKey({{Word::Kind::text, "a\nword\ttext b", 0}}),
                                     makeKey({{Word::Kind::text, "{out}", 0}}),
                                     makeKey({{Word::Kind::output, "", 0}})};
    EXPECT_EQ(keys.size(), 6u);
}

TEST_F(Keys, aResultIsFoundByTheStateOfWhatItRead)
{
    const Graph graph = makeCookGraph(settingsIn(folder)).value();
    const Action& import = graph.actions[0];
    const std::vector<std::string> parts(import.inputs.size());
    const auto cacheHere = [&]
    {
        std::vector<std::unique_ptr<cache::CacheLevel>> levels;
        levels.push_back(std::make_unique<cache::DirectoryStore>(folder / "cache", true));
        return cache::Cache(std::move(levels), [](const Error&) { FAIL(); });
    };
    const auto found = [&]() -> std::string
    {
        cache::Cache cache = cacheHere();
        FileHashes hashes("/");
        ActionCache actions(cache, hashes, folder.path());
        const auto result = actions.find(import, *actions.makeRecord(import, parts)).result;
        return result ? result->outputs.at(0).hash + " " + result->warnings.at(0) : "nothing";
    };
    const auto keep = [&](const std::string& hash)
    {
        cache::Cache cache = cacheHere();
        FileHashes hashes("/");
        ActionCache actions(cache, hashes, folder.path());
        tools::DependencyList reads;
        reads.addFile(folder / "a.obj");
        reads.addFile(folder / "wood.png");
        reads.addFile(folder / "stone.png");
        const auto record = actions.recordFromReads(import, *actions.makeRecord(import, parts), reads);
        actions.store(import, *record,
                      {{{hash, 3}, {"statistics", 3}}, {import.subject + "|x: warning: y [W1]"}, 1, 1, 1});
    };
    EXPECT_EQ(found(), "nothing");
    keep("first");
    EXPECT_EQ(found(), "first " + folder / "a.obj|x: warning: y [W1]");
    folder.write("wood.png", "new wood");
    EXPECT_EQ(found(), "nothing");
    keep("second");
    EXPECT_EQ(found().substr(0, 6), "second");
    folder.write("stone.png", "now there is one");
    EXPECT_EQ(found(), "nothing");
    fs::remove(folder / "stone.png");
    folder.write("wood.png", "wood.png");
    EXPECT_EQ(found().substr(0, 5), "first") << "as it was at first";
}

TEST_F(Keys, whatChangedWhileItWasReadIsNotKept)
{
    const Graph graph = makeCookGraph(settingsIn(folder)).value();
    cache::Cache cache({}, [](const Error&) {});
    FileHashes hashes("/");
    ActionCache actions(cache, hashes, folder.path());
    const Record record = *actions.makeRecord(graph.actions[0], std::vector<std::string>(3));
    folder.write("a.obj", "edited while hearth-import reads it");
    tools::DependencyList reads;
    reads.addFile(folder / "a.obj");
    EXPECT_EQ(actions.recordFromReads(graph.actions[0], record, reads), std::nullopt);
    tools::DependencyList outside;
    outside.addAbsent("/nowhere/b.png");
    EXPECT_EQ(actions.recordFromReads(graph.actions[0], record, outside), std::nullopt);
}

TEST_F(Keys, hashesAreRememberedAsLongAsFilesLookUntouched)
{
    const std::string path = folder / "a.obj";
    const auto ask = [&](size_t expected_reads)
    {
        FileHashes hashes("/");
        hashes.load(folder / "hashes");
        const auto hash = hashes.hashFile(path);
        EXPECT_EQ(hash, tools::computeFileSha256(path));
        EXPECT_EQ(hashes.hashFile(path), hash);
        EXPECT_EQ(hashes.filesRead(), expected_reads);
        hashes.save(folder / "hashes");
    };
    // the hash of a file that was just written is not stored: an edit in the same clock tick would look the
    // same
    ask(1);
    ask(1);
    std::this_thread::sleep_for(std::chrono::milliseconds(3100));
    ask(1);
    ask(0);
    const auto time = fs::last_write_time(path);
    folder.write("a.obj", "A.obj");
    fs::last_write_time(path, time);
    ask(1);
    folder.write("hashes", "damaged");
    ask(1);
}

TEST(ElfLibraries, areThoseOfThisProgram)
{
    const std::vector<std::string> libraries = findLibraries("/proc/self/exe");
    const auto has = [&](const std::string& name)
    {
        return std::any_of(libraries.begin(), libraries.end(),
                           [&](const std::string& path)
                           { return path.find("/" + name) != std::string::npos; });
    };
    EXPECT_TRUE(has("libc.so.6"));
    EXPECT_TRUE(has("libstdc++.so.6"));
    EXPECT_TRUE(has("libcrypto.so")) << "linked for SHA-256";
    EXPECT_TRUE(findLibraries("/etc/passwd").empty());
    EXPECT_TRUE(findLibraries("/nowhere").empty());
}

} // namespace hearth::graph
