// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "tests/formats/malformed/malformed_packs.h"

#include <utility>

namespace hearth::test
{

const std::vector<MalformedPack>& malformedReceivers()
{
    static const std::vector<MalformedPack> list = {
        {"receiverAtlasTwice", Issue::meaning_value, "receivers 1",
         [](PackModel& p) { p.receiver_atlases.push_back(p.receiver_atlases[0]); }},
        {"receiverWithoutAtlas", Issue::meaning_range, "receivers 0",
         [](PackModel& p) { p.receiver_atlases.clear(); }},
        {"receiverNoWidth", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].width = 0; }},
        {"receiverWideAtlas", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].height = 16385; }},
        {"receiverCodec", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].codec = 2; }},
        {"receiverScale", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].scale = 0.75f; }},
        {"receiverNegativeScale", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].scale = -1; }},
        {"receiverSmallScale", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].scale = 0x1p-120f; }},
        {"receiverReserved", Issue::meaning_padding, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].reserved[2] = 1; }},
        {"receiverLampCount", Issue::meaning_range, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].lamp_count = 4; }},
        {"receiverWordCount", Issue::meaning_range, "receivers 0",
         [](PackModel& p) { p.receiver_words.pop_back(); }},
        {"receiverLampKind", Issue::meaning_value, "receiver lamp 2",
         [](PackModel& p) { p.receiver_lamps[2].kind = 3; }},
        {"receiverSteadyIndex", Issue::meaning_value, "receiver lamp 0",
         [](PackModel& p) { p.receiver_lamps[0].index = 1; }},
        {"receiverLampTwice", Issue::meaning_order, "receiver lamp 1",
         [](PackModel& p) { p.receiver_lamps[1] = p.receiver_lamps[0]; }},
        {"receiverLampOfNoLight", Issue::meaning_reference, "receiver lamp 1",
         [](PackModel& p) { p.receiver_lamps[1].index = 99; }},
        {"receiverLampOfNoInstance", Issue::meaning_reference, "receiver lamp 2",
         [](PackModel& p) { p.receiver_lamps[2].index = 99; }},
        {"receiverRectOfNoInstance", Issue::meaning_reference, "receiver rectangle 1",
         [](PackModel& p) { p.receiver_rects[1].instance = 99; }},
        {"receiverRectOrder", Issue::meaning_order, "receiver rectangle 1",
         [](PackModel& p) { p.receiver_rects[1].instance = 0; }},
        {"receiverEmptyRect", Issue::meaning_range, "receiver rectangle 0",
         [](PackModel& p) { p.receiver_rects[0].height = 0; }},
        {"receiverWideRect", Issue::meaning_range, "receiver rectangle 1",
         [](PackModel& p) { p.receiver_rects[1].width = 3; }},
        {"receiverRectBeyondNumbers", Issue::meaning_range, "receiver rectangle 1",
         [](PackModel& p) { p.receiver_rects[1].width = 0xFFFFFFFD; }},
        {"receiverRectOfUnknownUvs", Issue::meaning_value, "receiver rectangle 0",
         [](PackModel& p) { p.receiver_rects[0].uv_set = 4; }},
        {"receiverRectOfMissingUvs", Issue::meaning_reference, "receiver rectangle 1",
         [](PackModel& p) { p.receiver_rects[1].uv_set = 3; }},
        {"receiverRectsOverlap", Issue::meaning_value, "receiver rectangle 1",
         [](PackModel& p) { p.receiver_rects[1].x = 2; }},
        {"receiverEmptyBlock", Issue::meaning_value, "receiver block 0",
         [](PackModel& p) { p.receiver_blocks[0].texel_count = 0; }},
        {"receiverLargeBlock", Issue::meaning_value, "receiver block 0",
         [](PackModel& p) { p.receiver_blocks[0].texel_count = 65; }},
        {"receiverBlockWithoutColors", Issue::meaning_value, "receiver block 0",
         [](PackModel& p) { p.receiver_blocks[0].color_count = 0; }},
        {"receiverManyColors", Issue::meaning_value, "receiver block 0",
         [](PackModel& p) { p.receiver_blocks[0].color_count = 13; }},
        {"receiverBlockGroup", Issue::meaning_value, "receiver block 1",
         [](PackModel& p) { p.receiver_blocks[1].group = 4; }},
        {"receiverBlockWordsOrder", Issue::meaning_order, "receiver block 1",
         [](PackModel& p) { p.receiver_blocks[1].first_word = 5; }},
        {"receiverBlockWords", Issue::meaning_range, "receiver block 1",
         [](PackModel& p) { p.receiver_blocks[1].texel_count = 64; }},
        {"receiverGroupsFall", Issue::meaning_order, "receiver block 1",
         [](PackModel& p)
         {
             p.receiver_blocks[0].group = 3;
             p.receiver_words[0] = p.receiver_words[1] = 1 | 1 << 14;
             p.receiver_words[1] = 1 | 3 << 14;
             p.receiver_blocks[1].group = 2;
         }},
        {"receiverLampBehindColors", Issue::meaning_padding, "receiver block 0",
         [](PackModel& p) { p.receiver_blocks[0].lamps[5] = 1; }},
        {"receiverLampOfBlock", Issue::meaning_reference, "receiver block 1",
         [](PackModel& p) { p.receiver_blocks[1].lamps[1] = 3; }},
        {"receiverLampsOfBlockFall", Issue::meaning_order, "receiver block 1",
         [](PackModel& p) { p.receiver_blocks[1].lamps[1] = 1; }},
        {"receiverPlaceBits", Issue::meaning_padding, "receiver block 0",
         [](PackModel& p) { p.receiver_words[0] |= 1u << 29; }},
        {"receiverPlaceOutside", Issue::meaning_range, "receiver block 0",
         [](PackModel& p) { p.receiver_words[1] = 6; }},
        {"receiverPlaceBelow", Issue::meaning_range, "receiver block 0",
         [](PackModel& p) { p.receiver_words[1] = 4 << 14; }},
        {"receiverPlaceGroup", Issue::meaning_value, "receiver block 0",
         [](PackModel& p) { p.receiver_words[1] = 1; }},
        {"receiverPlaceOrder", Issue::meaning_order, "receiver block 0",
         [](PackModel& p) { std::swap(p.receiver_words[0], p.receiver_words[1]); }},
        {"receiverPlaceTwice", Issue::meaning_order, "receiver block 0",
         [](PackModel& p) { p.receiver_words[1] = p.receiver_words[0]; }},
        {"receiverPlaceOutsideRects", Issue::meaning_value, "receiver block 0",
         [](PackModel& p)
         {
             p.receiver_rects[1].height = 1;
             p.receiver_words[1] = 4 | 2 << 14;
         }},
        {"receiverTexelTwice", Issue::meaning_value, "receiver block 1",
         [](PackModel& p)
         {
             p.receiver_blocks[1] = {6, 1, 3, 0, {1u << 16, 2, 0, 0, 0, 0}};
             p.receiver_words[6] = 0;
         }},
        {"receiverWordOfNoBlock", Issue::meaning_range, "receiver word 10",
         [](PackModel& p)
         {
             p.receiver_words.push_back(0);
             p.receiver_atlases[0].word_count = 11;
         }},
        {"faceAtlasTwice", Issue::meaning_value, "face receivers 1",
         [](PackModel& p) { p.face_atlases.push_back(p.face_atlases[0]); }},
        {"faceBlocksWithoutAtlas", Issue::meaning_range, "face receivers 0",
         [](PackModel& p) { p.face_atlases.clear(); }},
        {"receiverLampsAlone", Issue::meaning_range, "receiver lamp 0",
         [](PackModel& p)
         {
             p.face_atlases.clear();
             p.face_blocks.clear();
             p.face_words.clear();
             p.receiver_atlases.clear();
             p.receiver_rects.clear();
             p.receiver_blocks.clear();
             p.receiver_words.clear();
         }},
        {"faceAtlasRectangles", Issue::meaning_range, "face receivers 0",
         [](PackModel& p) { p.face_atlases[0].rect_count = 1; }},
        {"faceLampCount", Issue::meaning_range, "face receivers 0",
         [](PackModel& p) { p.face_atlases[0].lamp_count = 2; }},
        {"faceOfOtherGrid", Issue::meaning_reference, "face receivers 0",
         [](PackModel& p) { p.face_atlases[0].width += 1; }},
        {"faceOfNoGrid", Issue::meaning_reference, "face receivers 0",
         [](PackModel& p)
         {
             p.brick_grids.clear();
             p.bricks = {};
         }},
        {"faceBlockLamp", Issue::meaning_reference, "face block 1",
         [](PackModel& p) { p.face_blocks[1].lamps[0] = 3; }},
        {"faceTwice", Issue::meaning_value, "face block 1",
         [](PackModel& p)
         {
             p.face_blocks[1].group = 0;
             p.face_words[6] = 0;
         }},
        {"faceBeyondGrid", Issue::meaning_range, "face block 1",
         [](PackModel& p) { p.face_words[6] = 16383; }},
        {"faceWordOfNoBlock", Issue::meaning_range, "face word 8",
         [](PackModel& p)
         {
             p.face_words.push_back(0);
             p.face_atlases[0].word_count = 9;
         }},
        {"receiverTexelCount", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].texel_count = 2; }},
        {"receiverGroupBlocks", Issue::meaning_value, "receivers 0",
         [](PackModel& p) { p.receiver_atlases[0].group_blocks[1] = 1; }},
    };
    return list;
}

} // namespace hearth::test
