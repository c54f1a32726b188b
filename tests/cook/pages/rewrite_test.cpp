// Tests the rewriting of visibilities in a clusters part.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/pages/rewrite.h"
#include "tests/cook/pages/sample_part.h"

#include <atomic>
#include <set>

#include <tbb/global_control.h>

namespace
{

using namespace hearth;
using namespace hearth::formats;
using pages::getMessage;
using pages::open;
using pages::PageVertices;
using pages::readFile;

class Rewrite : public pages::SamplePart
{
};

/// Return a visibility code that depends on the position alone, so that clusters agree on shared vertices.
uint32_t formatCode(Float3 position)
{
    const auto wave = [](float x) { return std::abs(std::sin(7 * x)); };
    const float share = wave(position.x + position.y) * wave(position.z);
    return encodeVisibility(6.2f * share, {0, 0.1f * share, 3 * share}, {0, 0, 1});
}

void editByPlace(const PageVertices& page, std::span<uint32_t> codes)
{
    size_t next = 0;
    for (const ClusterGeometry& cluster : page.geometry)
        for (uint32_t v = 0; v < cluster.vertexCount(); ++v)
            codes[next++] = formatCode(cluster.position(v));
    ASSERT_EQ(next, codes.size());
}

TEST_F(Rewrite, ofNothingIsTheSameToTheByte)
{
    const std::string out = folder.file("same.part");
    std::atomic<uint32_t> vertices = 0, open_vertices = 0;
    const auto count = [&](const PageVertices&, std::span<uint32_t> codes)
    {
        vertices += static_cast<uint32_t>(codes.size());
        open_vertices += static_cast<uint32_t>(std::count(codes.begin(), codes.end(), kVisibilityUnoccluded));
    };
    ASSERT_EQ(getMessage(pages::rewriteVisibility(open(path), out, count)), "");
    EXPECT_TRUE(readFile(path) == readFile(out));
    EXPECT_EQ(vertices, open_vertices) << "as hearth-clusters writes them";
    EXPECT_GT(vertices, 10000u);
}

TEST_F(Rewrite, changesVisibilitiesAndNothingElse)
{
    const std::string out = folder.file("edited.part");
    ASSERT_EQ(getMessage(pages::rewriteVisibility(open(path), out, editByPlace)), "");
    const auto before = PackView::read(open(path)), after = PackView::read(open(out));
    ASSERT_TRUE(before.ok() && after.ok());
    EXPECT_EQ(getMessage(checkHierarchy(*after)), "");
    for (uint32_t p = 0; p < before->pages().size(); ++p)
    {
        const std::vector<std::byte> old_bytes = before->decodePage(p).value();
        const std::vector<std::byte> new_bytes = after->decodePage(p).value();
        ASSERT_EQ(old_bytes.size(), new_bytes.size());
        const PageRecord& page = before->pages()[p];
        const MeshRecord& mesh = before->meshes()[page.mesh];
        std::vector<std::byte> reverted = new_bytes;
        for (const ClusterRecord& record : recordsInRange(after->clusters(), page.clusters))
        {
            const auto geometry = ClusterGeometry::at(new_bytes, record, mesh);
            ASSERT_TRUE(geometry.has_value());
            for (uint32_t v = 0; geometry->has(kVertexVisibility) && v < geometry->vertexCount(); ++v)
            {
                ASSERT_EQ(geometry->visibilityCode(v), formatCode(geometry->position(v)));
                const uint32_t layout = geometry->layout();
                const size_t word = record.page_word + uvBaseWords(layout) + v * vertexWords(layout) +
                                    attributeWord(layout, kVertexVisibility);
                std::memcpy(reverted.data() + word * 4, &kVisibilityUnoccluded, 4);
            }
        }
        ASSERT_TRUE(reverted == old_bytes) << "page " << p;
    }
    // and back to the original
    const std::string back = folder.file("back.part");
    const auto open_all = [](const PageVertices&, std::span<uint32_t> codes)
    { std::fill(codes.begin(), codes.end(), kVisibilityUnoccluded); };
    ASSERT_EQ(getMessage(pages::rewriteVisibility(open(out), back, open_all)), "");
    EXPECT_TRUE(readFile(path) == readFile(back));
}

TEST_F(Rewrite, ofManyThreadsIsThatOfOne)
{
    const std::string one = folder.file("one.part"), many = folder.file("many.part");
    {
        const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 1);
        ASSERT_EQ(getMessage(pages::rewriteVisibility(open(path), one, editByPlace)), "");
    }
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, 4);
    ASSERT_EQ(getMessage(pages::rewriteVisibility(open(path), many, editByPlace)), "");
    EXPECT_TRUE(readFile(one) == readFile(many));
}

TEST_F(Rewrite, leavesMeshesWithoutNormalsAlone)
{
    const auto view = PackView::read(open(path));
    ASSERT_TRUE(view.ok());
    EXPECT_EQ(view->meshes()[0].attributes & kVertexVisibility, kVertexVisibility);
    EXPECT_EQ(view->meshes()[5].attributes & kVertexVisibility, 0u);
    std::array<std::atomic<uint32_t>, 6> pages_of_mesh{};
    const auto count = [&](const PageVertices& page, std::span<uint32_t>)
    {
        EXPECT_EQ(page.geometry.size(), page.clusters.count);
        EXPECT_EQ(view->pages()[page.page].clusters.first, page.clusters.first);
        ++pages_of_mesh[page.mesh];
    };
    ASSERT_EQ(getMessage(pages::rewriteVisibility(open(path), folder.file("out.part"), count)), "");
    for (uint32_t mesh = 0; mesh < 5; ++mesh)
        EXPECT_EQ(pages_of_mesh[mesh], view->meshes()[mesh].pages.count);
    EXPECT_EQ(pages_of_mesh[5], 0u);
}

/// A part that is baked twice has the chunks of the second time.
TEST_F(Rewrite, replacesChunks)
{
    const auto bake = [&](const std::string& from, const std::string& to, uint32_t transfer)
    {
        const SurroundingsRecord record{transfer, {0, 0, 0, kHalfOne}};
        const auto keep = [](const PageVertices&, std::span<uint32_t>) {};
        return pages::rewriteVisibility(
            open(from), to, keep,
            {.types = {kChunkSurroundings}, .write = [record](ContainerWriter& writer) {
                 return writer.addRecords<SurroundingsRecord>(kChunkSurroundings, {&record, 1});
             }});
    };
    const std::string once = folder.file("once.part"), twice = folder.file("twice.part");
    ASSERT_EQ(getMessage(bake(path, once, 3)), "");
    ASSERT_EQ(getMessage(bake(once, twice, 5)), "");
    const auto view = PackView::read(open(twice));
    ASSERT_TRUE(view.ok());
    ASSERT_EQ(view->surroundings().size(), 1u);
    EXPECT_EQ(view->surroundings()[0].transfer, 5u);
    EXPECT_EQ(view->clusters().size(), PackView::read(open(path))->clusters().size());
}

TEST_F(Rewrite, refusesPagesOfAnotherCodec)
{
    const test::AlignedBytes bytes = test::smallPack().bytes();
    const auto pack = ContainerReader::fromBytes(bytes.span(), "small.hearth");
    ASSERT_TRUE(pack.ok());
    const std::string out = folder.file("out.part");
    const Status status =
        pages::rewriteVisibility(*pack, out, [](const PageVertices&, std::span<uint32_t>) {});
    ASSERT_FALSE(status.ok());
    EXPECT_EQ(status.error().issue, Issue::chunk_codec) << formatMessage(status.error());
    EXPECT_FALSE(std::ifstream(out).good());
}

} // namespace
