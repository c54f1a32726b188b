// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "day.h"

#include "vec.h"

namespace game
{

Day::Day(const hearth::Pack& pack)
{
    for (const char* name : {"fire", "lamp_1", "lamp_2", "lamp_3", "lamp_4"})
    {
        std::string why;
        hearth_lamp_weight lamp{HEARTH_LAMP_LIGHT, 0, {1, 1, 1}};
        check(pack.findRecord(HEARTH_TABLE_LIGHTS, name, lamp.index, 0, &why), why);
        lamps_.push_back(lamp);
    }
}

void Day::light(hearth_frame& frame)
{
    // the sun rises in the east (+X) at 6, and stands highest in the south (+Z)
    const float angle = (hour - 6) * kPi / 12, height = 58 * std::sin(angle);
    daylight_ = {std::fmax(height, 0.0f), 90 + angle * 180 / kPi, 3, 0};
    frame.daylight = &daylight_;

    // the eye gets used to dusk, and sees less at night, and blue; lamps look as bright as ever
    const float night = smooth(1, -14, height), stops = 1.5f * smooth(14, 1, height) - 1.9f * night;
    frame.exposure_stops = stops;
    frame.filter_density = 0.75f * night;
    const float night_color[] = {0.35f, 0.5f, 1};
    for (int i = 0; i < 3; ++i)
        frame.filter_color[i] = night_color[i];
    const float fire = std::exp2(-stops), lamp = smooth(9, 1, height) * fire;
    for (hearth_lamp_weight& weight : lamps_)
        for (float& channel : weight.weight)
            channel = &weight == &lamps_.front() ? fire : lamp;
    frame.lamp_weights = lamps_.data();
    frame.lamp_weight_count = static_cast<uint32_t>(lamps_.size());
}

} // namespace game
