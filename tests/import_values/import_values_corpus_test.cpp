// Compares every value that the import reads of the good glTF files of the asset corpus with what tinygltf
// reads.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/import_values/imported_source.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

std::vector<std::string> findSources(const std::string& folder)
{
    std::vector<std::string> paths;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (const auto ending = entry.path().extension(); ending == ".gltf" || ending == ".glb")
            paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// Minimum number of compared values of each kind: a comparison of nothing must fail. About half of those in
/// the corpus of today without its largest meshes.
struct MinCompared
{
    Value kind;
    size_t count;
};
constexpr MinCompared kMinCompared[] = {
    {Value::structure, 2'000'000},   {Value::position, 1'300'000},   {Value::normal, 1'300'000},
    {Value::flat_normal, 14'000},    {Value::tangent, 200'000},      {Value::uv, 1'000'000},
    {Value::color, 50'000},          {Value::joint, 200'000},        {Value::weight, 200'000},
    {Value::morph_delta, 1'600'000}, {Value::key_time, 100'000},     {Value::key_value, 390'000},
    {Value::node, 36'000},           {Value::instance, 78'000},      {Value::inverse_bind, 5'000},
    {Value::factor, 1'600},          {Value::texture_transform, 400}};

} // namespace

TEST(ImportValuesCorpus, areThoseThatTinygltfReads)
{
    const char* assets = std::getenv("HEARTH_ASSETS");
    if (assets == nullptr)
        GTEST_SKIP() << "HEARTH_ASSETS names no folder of assets";
    Sandbox folder;
    Comparison all("");
    size_t files = 0;
    for (const std::string& path : findSources(std::string(assets) + "/good"))
    {
        const Comparison comparison = importAndCompare(folder, path, path.substr(path.find("/good/") + 6));
        EXPECT_EQ(comparison.differences(), 0u) << comparison.report();
        all.add(comparison);
        ++files;
    }
    std::printf("%zu files\n%s", files, all.table().c_str());
    EXPECT_GE(files, 90u);
    static_assert(std::size(kMinCompared) == static_cast<size_t>(Value::count));
    for (const MinCompared& min : kMinCompared)
        EXPECT_GE(all.compared(min.kind), min.count) << valueName(min.kind);
}

} // namespace hearth::test
