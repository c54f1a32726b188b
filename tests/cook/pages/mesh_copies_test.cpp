// Tests the copies of meshes in a clusters part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/mesh_copies.h"

#include "tests/cook/pages/sample_part.h"

#include <algorithm>
#include <cstring>

namespace hearth::pages
{

namespace
{

class MeshCopies : public SamplePart
{
protected:
    PackView copy(std::span<const uint32_t> meshes)
    {
        const std::string out = folder.file("copies.part");
        EXPECT_EQ(getMessage(copyMeshes(PackView::read(open(path)).value(), meshes, out)), "");
        return PackView::read(open(out)).value();
    }
};

template <typename T>
bool sameBytes(std::span<const T> a, std::span<const T> b)
{
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size_bytes()) == 0;
}

/// Return the decoded pages of a mesh.
std::vector<std::vector<std::byte>> decodePages(const PackView& part, const MeshRecord& mesh)
{
    std::vector<std::vector<std::byte>> pages;
    for (uint32_t page = 0; page < mesh.pages.count; ++page)
        pages.push_back(part.decodePage(mesh.pages.first + page).value());
    return pages;
}

} // namespace

TEST_F(MeshCopies, haveTheGeometryOfTheirMeshes)
{
    const PackView before = PackView::read(open(path)).value();
    const std::vector<uint32_t> meshes{3, 0, 3, 4};
    const PackView after = copy(meshes);
    EXPECT_EQ(getMessage(checkHierarchy(after)), "");
    ASSERT_EQ(after.meshes().size(), before.meshes().size() + meshes.size());
    for (size_t i = 0; i < meshes.size(); ++i)
    {
        const MeshRecord &mesh = before.meshes()[meshes[i]],
                         &copied = after.meshes()[before.meshes().size() + i];
        EXPECT_EQ(copied.attributes, mesh.attributes);
        EXPECT_EQ(copied.source_triangles, mesh.source_triangles);
        EXPECT_GT(mesh.pages.count, 0u);
        EXPECT_TRUE(decodePages(after, copied) == decodePages(before, mesh)) << "mesh " << meshes[i];
        const auto levels = recordsInRange(before.levels(), mesh.levels),
                   copied_levels = recordsInRange(after.levels(), copied.levels);
        ASSERT_EQ(copied_levels.size(), levels.size());
        for (size_t level = 0; level < levels.size(); ++level)
            EXPECT_EQ(copied_levels[level].clusters.first - copied.clusters.first,
                      levels[level].clusters.first - mesh.clusters.first);
        for (uint32_t page = copied.pages.first; page < copied.pages.first + copied.pages.count; ++page)
            EXPECT_EQ(after.pages()[page].mesh, before.meshes().size() + i);
    }
}

TEST_F(MeshCopies, leaveTheMeshesAsTheyAre)
{
    const PackView before = PackView::read(open(path)).value();
    const std::vector<uint32_t> meshes{1};
    const PackView after = copy(meshes);
    EXPECT_TRUE(sameBytes(after.meshes().first(before.meshes().size()), before.meshes()));
    EXPECT_TRUE(sameBytes(after.groups().first(before.groups().size()), before.groups()));
    EXPECT_TRUE(sameBytes(after.clusters().first(before.clusters().size()), before.clusters()));
    EXPECT_TRUE(sameBytes(after.pages().first(before.pages().size()), before.pages()));
    EXPECT_TRUE(sameBytes(after.pageBytes().first(before.pageBytes().size()), before.pageBytes()));
    EXPECT_EQ(after.strings(), before.strings());
}

TEST_F(MeshCopies, takeTheBytesThatTheySay)
{
    const PackView part = PackView::read(open(path)).value();
    for (uint32_t mesh = 0; mesh < part.meshes().size(); ++mesh)
    {
        const std::vector<uint32_t> meshes{mesh};
        const PackView after = copy(meshes);
        const auto tableBytes = [](const PackView& view)
        {
            return view.meshes().size_bytes() + view.levels().size_bytes() + view.groups().size_bytes() +
                   view.clusters().size_bytes() + view.pages().size_bytes() +
                   view.pageParents().size_bytes() + view.pageBytes().size();
        };
        EXPECT_EQ(tableBytes(after) - tableBytes(part), countCopyBytes(part, mesh)) << mesh;
    }
}

} // namespace hearth::pages
