// Tests which lamps of a pack are found by name.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "runtime/pack/receivers/lamp_names.h"

#include "tests/support/small_pack.h"

#include <gtest/gtest.h>

namespace hearth::test
{

namespace
{

using formats::ReceiverLampKind;

formats::StringRef addName(PackModel& pack, const std::string& name)
{
    const auto offset = static_cast<uint32_t>(pack.strings.size());
    pack.strings += name;
    return {offset, static_cast<uint32_t>(name.size())};
}

/// Pack with two lights of one name, one of another, and an instance that emits.
PackModel namedPack()
{
    PackModel pack = smallPack();
    const formats::LightRecord light = pack.lights.front();
    pack.lights.assign(3, light);
    pack.lights[0].name = pack.lights[2].name = addName(pack, "ceiling");
    pack.lights[1].name = addName(pack, "desk");
    pack.nodes[pack.instances[1].node].name = addName(pack, "screen");
    pack.receiver_lamps = {{0, 0}, {1, 0}, {2, 1}};
    return pack;
}

/// Read a pack. The bytes must outlive it.
formats::PackView read(const AlignedBytes& bytes)
{
    auto reader = formats::ContainerReader::fromBytes(bytes.span(), "named.hearth");
    HEARTH_ASSERT(reader.ok());
    auto pack = formats::PackView::read(std::move(*reader));
    HEARTH_ASSERT(pack.ok());
    return std::move(pack).value();
}

} // namespace

TEST(LampNames, nameLightsAndInstancesThatEmit)
{
    const PackModel model = namedPack();
    const AlignedBytes bytes = model.bytes();
    const formats::PackView pack = read(bytes);
    EXPECT_EQ(pack::listLamps(pack).size(), 4u);
    const auto ceiling = pack::findLamps(pack, "ceiling");
    ASSERT_TRUE(ceiling.ok());
    ASSERT_EQ(ceiling->size(), 2u);
    EXPECT_EQ((*ceiling)[1].index, 2u);
    const auto screen = pack::findLamps(pack, "screen");
    ASSERT_TRUE(screen.ok());
    EXPECT_EQ((*screen)[0].kind, ReceiverLampKind::mesh_light);
    EXPECT_EQ((*screen)[0].index, 1u);
}

TEST(LampNames, anUnknownNameTellsTheOthers)
{
    const PackModel model = namedPack();
    const AlignedBytes bytes = model.bytes();
    const formats::PackView pack = read(bytes);
    for (const char* name : {"floor", ""})
    {
        const auto none = pack::findLamps(pack, name);
        ASSERT_FALSE(none.ok());
        EXPECT_NE(formatMessage(none.error()).find("ceiling, desk, screen"), std::string::npos)
            << formatMessage(none.error());
    }
}

} // namespace hearth::test
