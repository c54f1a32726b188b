// Tests the import part, its report, and the JSON that is read and written.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "pipelines/import/gltf/document/json_document.h"
#include "pipelines/import/source/asset_folder.h"
#include "tests/pipelines/gltf_fixture.h"

#include <sys/stat.h>

namespace hearth::import::test
{

namespace
{

TEST(JsonDocument, knowsThePlaceOfEveryValue)
{
    const auto document = JsonDocument::parse(R"({"a":[1,{"b/c":true,"d~":"x"}],"e":null})", "f");
    ASSERT_TRUE(document.ok());
    const Json root = document->root();
    EXPECT_EQ(root.pointer(), "");
    const Json inner = (*root.find("a"))[1];
    EXPECT_EQ(inner.pointer(), "/a/1");
    EXPECT_EQ(inner.find("b/c")->pointer(), "/a/1/b~1c");
    EXPECT_EQ(inner.find("d~")->pointer(), "/a/1/d~0");
    EXPECT_EQ(inner.find("d~")->string(), "x");
    EXPECT_EQ(root.find("e")->type(), JsonType::null);
    EXPECT_FALSE(root.find("f").has_value());
    EXPECT_EQ((*root.find("a"))[0].number(), 1);
    EXPECT_EQ(root.size(), 2u);
}

TEST(JsonDocument, takesTheLastOfEqualNames)
{
    const auto document = JsonDocument::parse(R"({"a":1,"a":2})", "f");
    ASSERT_TRUE(document.ok());
    EXPECT_EQ(document->root().find("a")->number(), 2);
}

TEST(JsonDocument, refusesWhatIsNotJson)
{
    const std::string texts[] = {"",
                                 "{",
                                 "[1,]",
                                 "{\"a\":NaN}",
                                 "{\"a\":Infinity}",
                                 "{} {}",
                                 "{\"a\":1e999}",
                                 "{a:1}",
                                 "[\"\xFF\"]",
                                 "[\"a\nb\"]",
                                 "// x\n{}",
                                 "{'a':1}",
                                 "\xEF\xBB\xBF{}",
                                 std::string("{\0}", 3),
                                 "[01]"};
    for (const std::string& text : texts)
    {
        const auto document = JsonDocument::parse(text, "f");
        ASSERT_FALSE(document.ok()) << text;
        EXPECT_EQ(document.error().issue, Issue::json_syntax) << text;
    }
}

TEST(JsonDocument, saysTheLineOfAnError)
{
    const auto document = JsonDocument::parse("{\n\"a\": 1,\n  x}", "f");
    ASSERT_FALSE(document.ok());
    EXPECT_EQ(document.error().where, "line 3");
    EXPECT_EQ(document.error().detail, "not JSON at column 3");
}

TEST(JsonDocument, limitsTheDepth)
{
    const auto nested = [](size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_TRUE(JsonDocument::parse(nested(128), "f").ok());
    EXPECT_FALSE(JsonDocument::parse(nested(129), "f").ok());
    EXPECT_FALSE(JsonDocument::parse(std::string(1000000, '['), "f").ok());
}

TEST(PartBuilder, writesAReportThatNamesSourcesCountsAndMessages)
{
    const TemporaryFolder folder;
    auto part = PartBuilder::create(folder.path("a.part"), "some/folder/model.gltf");
    ASSERT_TRUE(part.ok());
    part->addSource("model.gltf", std::as_bytes(std::span("abc", 3)));
    part->counts.triangles = 12;
    part->warn(Issue::dropped, "/meshes/0", "attribute _X");
    part->warn(Issue::repaired, "", "something");
    ASSERT_TRUE(part->finish().ok());
    const auto reader = formats::ContainerReader::open(folder.path("a.part"));
    ASSERT_TRUE(reader.ok());
    EXPECT_EQ(reader->kind(), formats::ContainerKind::part);
    const auto meta = reader->read(formats::kChunkMeta);
    const std::string text(reinterpret_cast<const char*>(meta->bytes().data()), meta->bytes().size());
    const auto document = JsonDocument::parse(text, "META");
    ASSERT_TRUE(document.ok()) << text;
    const Json root = document->root();
    EXPECT_EQ(root.find("schema")->string(), "hearth.import/1");
    EXPECT_EQ(root.find("source")->string(), "model.gltf") << "nothing of the machine's folders";
    EXPECT_EQ(root.find("counts")->find("triangles")->number(), 12);
    const Json source = (*root.find("sources"))[0];
    EXPECT_EQ(source.find("bytes")->number(), 3);
    EXPECT_EQ(source.find("xxh3")->string(), "78af5f94892f3950"); // XXH3-64 of "abc"
    const Json message = (*root.find("messages"))[0];
    EXPECT_EQ(message.find("code")->string(), "W1400");
    EXPECT_EQ(message.find("severity")->string(), "warning");
    EXPECT_EQ(message.find("pointer")->string(), "/meshes/0");
    EXPECT_EQ(root.find("dropped")->size(), 1u);
}

TEST(PartBuilder, sharesEqualStringsAndKeepsThemUtf8)
{
    const TemporaryFolder folder;
    auto part = PartBuilder::create(folder.path("a.part"), "x");
    ASSERT_TRUE(part.ok());
    const auto a = part->intern("tree");
    const auto b = part->intern("tree");
    EXPECT_EQ(a.offset, b.offset);
    EXPECT_EQ(part->intern("").length, 0u);
    const auto damaged = part->intern("\xC3\xA9\xFF\xC0\xAF\xED\xA0\x80z");
    EXPECT_EQ(damaged.offset, 4u);
    EXPECT_EQ(damaged.length, 9u);
    ASSERT_TRUE(part->finish().ok());
    const auto reader = formats::ContainerReader::open(folder.path("a.part"));
    const auto strings = reader->read(formats::kChunkStrings);
    EXPECT_EQ(std::string(reinterpret_cast<const char*>(strings->bytes().data()), strings->bytes().size()),
              "tree\xC3\xA9??????z");
}

TEST(PartBuilder, countsWhatNobodyWouldRead)
{
    const TemporaryFolder folder;
    auto part = PartBuilder::create(folder.path("a.part"), "x");
    ASSERT_TRUE(part.ok());
    for (int i = 0; i < 1000; ++i)
        part->warn(Issue::repaired, std::string(10000, 'a'), std::string(10000, 'b'));
    EXPECT_EQ(part->warnings().size(), 100u);
    EXPECT_EQ(part->omittedWarningCount(), 900u);
    EXPECT_LT(formatMessage(part->warnings()[0]).size(), 1000u);
}

TEST(PartBuilder, leavesNothingBehindWhenItIsNotFinished)
{
    const TemporaryFolder folder;
    {
        auto part = PartBuilder::create(folder.path("a.part"), "x");
        ASSERT_TRUE(part.ok());
    }
    EXPECT_TRUE(folder.empty());
}

TEST(PartBuilder, givesTheSameBytesAgain)
{
    const auto bytes = []
    {
        GltfData data;
        data.add("VEC3", kSquare);
        data.add("SCALAR", kSquareIndices);
        const Imported result = data.import(
            R"("nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}])");
        std::ifstream file(result.folder->path("out.part"), std::ios::binary);
        return std::string(std::istreambuf_iterator<char>(file), {});
    };
    const std::string first = bytes();
    EXPECT_FALSE(first.empty());
    EXPECT_EQ(first, bytes());
}

TEST(ReadFile, refusesWhatIsNotARegularFile)
{
    const TemporaryFolder folder;
    ASSERT_EQ(::mkfifo(folder.path("pipe").c_str(), 0600), 0);
    folder.write("file", "1234");
    for (const std::string& path :
         {folder.path("pipe"), folder.path(""), folder.path("absent"), std::string("/dev/zero")})
    {
        const auto result = FileBytes::read(path, 100);
        ASSERT_FALSE(result.ok()) << path;
        EXPECT_EQ(result.error().issue, Issue::input_missing) << path;
    }
    EXPECT_EQ(FileBytes::read(folder.path("file"), 3).error().issue, Issue::input_too_large);
    EXPECT_EQ(FileBytes::read(folder.path("file"), 4)->bytes().size(), 4u);
}

} // namespace

} // namespace hearth::import::test
