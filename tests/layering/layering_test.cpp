// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/layering/layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

namespace hearth::test
{

namespace
{

namespace fs = std::filesystem;

const fs::path kRoot = HEARTH_SOURCE_DIR;
constexpr const char* kFolders[] = {"formats", "cook", "pipelines", "runtime", "sample_assets", "tests"};

std::string readContent(const fs::path& path)
{
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

bool isShader(const fs::path& path)
{
    const std::string extension = path.extension().string();
    return extension == ".glsl" || extension == ".comp" || extension == ".vert" || extension == ".frag";
}

/// Paths, relative to the root, of all C++ sources and, if `with_shaders`, of all GLSL sources.
std::vector<std::string> sources(bool with_shaders = false)
{
    std::vector<std::string> paths;
    for (const char* folder : kFolders)
        for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
            if (const fs::path& path = entry.path();
                path.extension() == ".h" || path.extension() == ".cpp" || (with_shaders && isShader(path)))
                paths.push_back(path.lexically_relative(kRoot).generic_string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// Includes of a source. A quoted name without a folder (headers that are installed together) is a file in
/// the same folder.
std::vector<Include> includesIn(const std::string& file)
{
    std::vector<Include> includes = findIncludes(readContent(kRoot / file));
    for (Include& include : includes)
        if (!include.angled && include.header.find('/') == std::string::npos)
            include.header = (fs::path(file).parent_path() / include.header).generic_string();
    return includes;
}

/// Links between the targets of the build: "folder of the target|folder of what it links|target", one a line.
std::vector<std::array<std::string, 3>> links()
{
    std::vector<std::array<std::string, 3>> list;
    std::ifstream file(HEARTH_LINKS_FILE);
    for (std::string line; std::getline(file, line);)
    {
        const size_t first = line.find('|'), second = line.find('|', first + 1);
        list.push_back(
            {line.substr(0, first), line.substr(first + 1, second - first - 1), line.substr(second + 1)});
    }
    return list;
}

} // namespace

TEST(Layering, includesFollowTheArrows)
{
    size_t count = 0;
    for (const std::string& file : sources(true))
        for (const Include& include : includesIn(file))
        {
            ++count;
            const auto wrong =
                include.angled ? wrongLibrary(file, include.header) : wrongArrow(file, include.header);
            EXPECT_FALSE(wrong.has_value()) << file << ":" << include.line << ": " << wrong.value_or("");
        }
    EXPECT_GT(count, 200u) << "the sources were not found";
}

TEST(Layering, everyArrowAndLibraryOfTheTablesIsUsed)
{
    std::vector<Arrow> arrows = allArrows();
    std::vector<std::string_view> libraries = allLibraries();
    for (const std::string& file : sources(true))
        for (const Include& include : includesIn(file))
        {
            if (include.angled)
                std::erase_if(
                    libraries, [&](std::string_view l)
                    { return l.ends_with('/') ? include.header.starts_with(l) : include.header == l; });
            else if (const auto arrow = findArrow(getFolder(file), getFolder(include.header)))
                std::erase(arrows, *arrow);
        }
    for (const Arrow& arrow : arrows)
        ADD_FAILURE() << arrow.from << " includes nothing of " << arrow.to;
    for (const std::string_view library : libraries)
        ADD_FAILURE() << "nobody includes " << library;
}

TEST(Layering, foldersHaveNoCycles)
{
    std::map<std::string, std::set<std::string>> arrows;
    for (const std::string& file : sources(true))
        for (const Include& include : includesIn(file))
            if (const std::string from(getFolder(file)), to(getFolder(include.header));
                !include.angled && from != to)
                arrows[from].insert(to);

    std::map<std::string, int> state; // 1: being visited, 2: done
    const auto visit = [&](const auto& self, const std::string& folder) -> void
    {
        state[folder] = 1;
        for (const std::string& next : arrows[folder])
        {
            EXPECT_NE(state[next], 1) << folder << " includes " << next << ", which includes it";
            if (state[next] == 0)
                self(self, next);
        }
        state[folder] = 2;
    };
    for (const auto& [folder, to] : std::map(arrows))
        if (state[folder] == 0)
            visit(visit, folder);
}

// A folder is read completely before it is changed.
TEST(Layering, foldersHaveAtMostFortySources)
{
    std::map<std::string, size_t> counts;
    for (const std::string& file : sources(true))
        ++counts[std::string(getFolder(file))];
    for (const auto& [folder, count] : counts)
        EXPECT_LE(count, 40u) << folder;
}

TEST(Layering, quotedIncludesAreFilesOfTheRepositoryOrGenerated)
{
    for (const std::string& file : sources(true))
        for (const Include& include : includesIn(file))
            EXPECT_TRUE(include.angled || include.header.starts_with("runtime/shaders/") ||
                        include.header.ends_with(".inc") || // shaders as words
                        fs::exists(kRoot / include.header))
                << file << ":" << include.line << ": " << include.header;
}

TEST(Layering, linksFollowTheArrows)
{
    const auto list = links();
    EXPECT_GT(list.size(), 5u) << HEARTH_LINKS_FILE;
    for (const auto& [folder, linked, target] : list)
    {
        const auto wrong = wrongLink(folder, linked);
        EXPECT_FALSE(wrong.has_value()) << target << ": " << wrong.value_or("");
    }
}

TEST(Layering, includesHaveNoCycles)
{
    std::map<std::string, std::vector<std::string>> headers_of_file;
    for (const std::string& file : sources())
        for (const Include& include : includesIn(file))
            if (!include.angled)
                headers_of_file[file].push_back(include.header);

    std::map<std::string, int> state; // 1: being visited, 2: done
    const auto visit = [&](const auto& self, const std::string& file) -> void
    {
        state[file] = 1;
        for (const std::string& header : headers_of_file[file])
        {
            EXPECT_NE(state[header], 1) << file << " includes " << header << ", which includes it";
            if (state[header] == 0)
                self(self, header);
        }
        state[file] = 2;
    };
    for (const std::string& file : sources())
        if (state[file] == 0)
            visit(visit, file);
}

TEST(Layering, sourcesStartWithALicenceLine)
{
    for (const std::string& file : sources())
        EXPECT_NE(readContent(kRoot / file)
                      .substr(0, 800)
                      .find("SPDX-License-Identifier: LicenseRef-Hearth-Undecided"),
                  std::string::npos)
            << file;
}

TEST(Layering, everyTestFileIsListed)
{
    for (const std::string& file : sources())
        if (file.ends_with("_test.cpp"))
        {
            fs::path folder = (kRoot / file).parent_path();
            while (!fs::exists(folder / "CMakeLists.txt"))
                folder = folder.parent_path();
            const std::string path = (kRoot / file).lexically_relative(folder).generic_string();
            EXPECT_NE(readContent(folder / "CMakeLists.txt").find(path), std::string::npos) << file;
        }
}

TEST(WrongArrow, knowsTheTable)
{
    const auto allowed = [](std::string_view file, std::string_view header)
    { return !wrongArrow(file, header).has_value(); };
    EXPECT_TRUE(allowed("cook/clusters/partition/split.cpp", "cook/mesh/weld.h"));
    EXPECT_TRUE(allowed("cook/clusters/partition/split.cpp", "cook/clusters/partition/split.h"));
    EXPECT_TRUE(allowed("cook/clusters/program/a.cpp", "cook/command_line/command_line.h"));
    EXPECT_TRUE(allowed("cook/json/json.cpp", "cook/json/json.h"));
    EXPECT_TRUE(allowed("runtime/gpu/scene/a.cpp", "runtime/pack/pack.h"));
    EXPECT_TRUE(allowed("runtime/c/a.cpp", "runtime/gpu/scene/scene.h")) << "below a folder of the table";
    EXPECT_TRUE(allowed("runtime/shaders/draw/a.frag", "formats/gpu_shared/records.h"));
    EXPECT_TRUE(allowed("tests/cook/a.cpp", "cook/clusters/partition/split.h"));
    EXPECT_FALSE(allowed("formats/records/mesh.h", "cook/mesh/weld.h"));
    EXPECT_FALSE(allowed("formats/gpu_shared/records.h", "formats/records/mesh.h"));
    EXPECT_FALSE(allowed("cook/mesh/weld.h", "cook/clusters/partition/split.h"));
    EXPECT_FALSE(allowed("cook/clusters/core/a.h", "cook/clusters/partition/split.h"));
    EXPECT_FALSE(allowed("cook/clusters/partition/split.cpp", "cook/textures/mips.h"));
    EXPECT_FALSE(allowed("cook/clusters/partition/split.cpp", "pipelines/link/link.h"));
    EXPECT_FALSE(allowed("cook/command_line/a.cpp", "cook/tools/batch.h"));
    EXPECT_FALSE(allowed("pipelines/cache/cache.cpp", "pipelines/graph/executor.h"));
    EXPECT_FALSE(allowed("pipelines/import/images/png.cpp", "pipelines/import/gltf/import_gltf.h"));
    EXPECT_FALSE(allowed("runtime/viewer/main.cpp", "cook/command_line/command_line.h"));
    EXPECT_FALSE(allowed("runtime/pack/pack.cpp", "runtime/gpu/vulkan/device.h"));
    EXPECT_FALSE(allowed("runtime/gpu/vulkan/a.cpp", "runtime/gpu/vulkanised/a.h"));
    EXPECT_FALSE(allowed("runtime/gpu/scene/scene.cpp", "cook/mesh/source_mesh.h"));
    EXPECT_FALSE(allowed("runtime/viewer/main.cpp", "pipelines/import/read_source.h"));
    EXPECT_FALSE(allowed("pipelines/import/a.cpp", "runtime/pack/pack.h"));
    EXPECT_FALSE(allowed("cook/clusters/partition/split.cpp", "tests/support/small_pack.h"));
    EXPECT_FALSE(allowed("tools/a.cpp", "formats/records/mesh.h"));
}

TEST(WrongLink, goesByTheFoldersOfALibrary)
{
    EXPECT_FALSE(wrongLink("cook/clusters", "formats"));
    EXPECT_FALSE(wrongLink("cook/clusters", "cook/pages"));
    EXPECT_FALSE(wrongLink("pipelines/command", "pipelines/graph"));
    EXPECT_TRUE(wrongLink("cook/clusters", "cook/textures"));
    EXPECT_TRUE(wrongLink("runtime/pack", "runtime/gpu"));
    EXPECT_TRUE(wrongLink("formats", "cook/tools"));
}

TEST(WrongLibrary, keepsLibrariesInTheirPlaces)
{
    const auto allowed = [](std::string_view file, std::string_view header)
    { return !wrongLibrary(file, header).has_value(); };
    EXPECT_TRUE(allowed("formats/a.h", "vector"));
    EXPECT_TRUE(allowed("formats/a.cpp", "sys/mman.h"));
    EXPECT_TRUE(allowed("formats/a.cpp", "zstd.h"));
    EXPECT_FALSE(allowed("formats/a.h", "zstd.h"));
    EXPECT_FALSE(allowed("runtime/gpu/a.cpp", "nlohmann/json.hpp"));
    EXPECT_FALSE(allowed("runtime/pack/a.cpp", "vulkan/vulkan.h"));
    EXPECT_TRUE(allowed("runtime/gpu/a.h", "vulkan/vulkan_core.h"));
    EXPECT_FALSE(allowed("cook/clusters/a.cpp", "gtest/gtest.h"));
    EXPECT_FALSE(allowed("pipelines/import/a.h", "draco/compression/decode.h"));
    EXPECT_FALSE(allowed("cook/mesh/a.cpp", "boost/optional.hpp"));
}

TEST(WrongLibrary, letsOneFileIncludeWhatIsSlowToCompile)
{
    EXPECT_FALSE(wrongLibrary("cook/command_line/command_line.cpp", "CLI/CLI.hpp").has_value());
    for (const char* file : {"cook/command_line/command_line.h", "cook/clusters/program/clusters_main.cpp",
                             "runtime/viewer/a.cpp", "tests/bench/a.cpp"})
        EXPECT_THAT(wrongLibrary(file, "CLI/CLI.hpp").value_or(""),
                    ::testing::HasSubstr("use cook/command_line/command_line.cpp"))
            << file;
}

TEST(IncludesOf, findsQuotedAndAngledLines)
{
    const auto includes =
        findIncludes("// #include \"no.h\"\n  #  include <a/b.h> // why\n#include \"c.h\"\n#define X\n");
    ASSERT_EQ(includes.size(), 2u);
    EXPECT_EQ(includes[0].header, "a/b.h");
    EXPECT_TRUE(includes[0].angled);
    EXPECT_EQ(includes[0].line, 2u);
    EXPECT_EQ(includes[1].header, "c.h");
    EXPECT_FALSE(includes[1].angled);
}

} // namespace hearth::test
