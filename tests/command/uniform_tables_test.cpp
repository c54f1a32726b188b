// Tests that sources with thousands of equal records are cooked, with the real cookers: Hearth reads what it
// has written, however well it compresses.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "cook/json/json.h"
#include "tests/support/sandbox.h"

#include <functional>
#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

/// Return a JSON array of `count` items.
std::string listItems(size_t count, const std::function<std::string(size_t)>& item)
{
    std::string list;
    for (size_t i = 0; i < count; ++i)
        list += (i == 0 ? "" : ",") + item(i);
    return "[" + list + "]";
}

/// Return a glTF of one triangle with the given nodes and materials.
std::string makeGltf(const std::string& nodes, const std::string& materials)
{
    return R"({"asset":{"version":"2.0"},"nodes":)" + nodes + R"(,"materials":)" + materials +
           R"(,"meshes":[{"primitives":[{"attributes":{"POSITION":0},"material":0}]}],)"
           R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",)"
           R"("min":[0,0,0],"max":[1,1,0]}],"bufferViews":[{"buffer":0,"byteLength":36}],)"
           R"("buffers":[{"byteLength":36,"uri":"data:application/octet-stream;base64,)"
           R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})";
}

class UniformTables : public ::testing::Test
{
protected:
    /// Cook a source, verify the pack, and return what hearth inspect says of it.
    Json inspectCooked(const std::string& gltf)
    {
        folder.write("a.gltf", gltf);
        for (const std::vector<std::string>& arguments :
             {std::vector<std::string>{"cook", "-q", "a.gltf", "-o", "a.hearth"}, {"verify", "a.hearth"}})
        {
            const ProgramEnd end = run(arguments);
            EXPECT_EQ(end.exit_code, 0) << end.err;
        }
        return Json::parse(run({"inspect", "--format", "json", "a.hearth"}).out).value_or(Json());
    }

    ProgramEnd run(std::vector<std::string> arguments)
    {
        arguments.insert(arguments.begin(), std::string(HEARTH_BIN) + "/hearth");
        return folder.run(arguments);
    }

    Sandbox folder;
};

const std::string kOneNode = R"([{"mesh":0}])";

} // namespace

TEST_F(UniformTables, ofEqualNodesAreCooked)
{
    const Json json =
        inspectCooked(makeGltf(listItems(20'000, [](size_t) { return R"({"mesh":0})"; }), R"([{}])"));
    EXPECT_EQ(json["totals"]["source"]["instances"], 20'000);
}

TEST_F(UniformTables, ofEqualMaterialsAreCooked)
{
    const Json json = inspectCooked(makeGltf(kOneNode, listItems(6'000, [](size_t) { return "{}"; })));
    EXPECT_EQ(json["totals"]["source"]["materials"], 6'000);
}

TEST_F(UniformTables, ofTwoKindsOfMaterialsAreCooked)
{
    const Json json = inspectCooked(makeGltf(
        kOneNode, listItems(12'000, [](size_t i) { return i % 2 == 0 ? "{}" : R"({"doubleSided":true})"; })));
    EXPECT_EQ(json["totals"]["source"]["materials"], 12'000);
}

} // namespace hearth::test
