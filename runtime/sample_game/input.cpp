// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#include "input.h"

#include "check.h"

#include <SDL.h>
#include <algorithm>
#include <cstdio>
#include <fstream>

namespace game
{

Input readDevices()
{
    const Uint8* const keys = SDL_GetKeyboardState(nullptr);
    const auto pair = [&](SDL_Scancode less, SDL_Scancode more)
    { return static_cast<float>(keys[more]) - static_cast<float>(keys[less]); };
    Input input{pair(SDL_SCANCODE_S, SDL_SCANCODE_W),
                pair(SDL_SCANCODE_A, SDL_SCANCODE_D),
                pair(SDL_SCANCODE_LEFT, SDL_SCANCODE_RIGHT),
                pair(SDL_SCANCODE_DOWN, SDL_SCANCODE_UP),
                keys[SDL_SCANCODE_LSHIFT] != 0,
                keys[SDL_SCANCODE_F] != 0};
    static SDL_GameController* pad = nullptr;
    if (pad == nullptr && SDL_NumJoysticks() > 0)
        pad = SDL_GameControllerOpen(0);
    if (pad == nullptr)
        return input;
    const auto axis = [](SDL_GameControllerAxis name)
    {
        const float value = SDL_GameControllerGetAxis(pad, name) / 32768.0f;
        return value * value < 0.03f ? 0 : value; // sticks do not rest at 0
    };
    const auto add = [](float& value, float more) { value = std::clamp(value + more, -1.0f, 1.0f); };
    add(input.forward, -axis(SDL_CONTROLLER_AXIS_LEFTY));
    add(input.right, axis(SDL_CONTROLLER_AXIS_LEFTX));
    add(input.turn, axis(SDL_CONTROLLER_AXIS_RIGHTX));
    add(input.tilt, -axis(SDL_CONTROLLER_AXIS_RIGHTY));
    input.is_running |= SDL_GameControllerGetButton(pad, SDL_CONTROLLER_BUTTON_RIGHTSHOULDER) != 0;
    input.is_waving |= SDL_GameControllerGetButton(pad, SDL_CONTROLLER_BUTTON_Y) != 0;
    return input;
}

Recording::Recording(const std::string& path)
{
    std::ifstream file(path);
    check(file.is_open(), path + ": cannot be read");
    std::string line;
    for (int number = 1; std::getline(file, line); ++number)
    {
        if (line.empty() || line[0] == '#')
            continue;
        unsigned count = 0, is_running = 0, is_waving = 0;
        Frame frame{};
        Input& input = frame.input;
        const int read =
            std::sscanf(line.c_str(), "%u %f %f %f %f %u %u %f", &count, &input.forward, &input.right,
                        &input.turn, &input.tilt, &is_running, &is_waving, &frame.hour);
        check(read == 8 && count <= 100000, path + ":" + std::to_string(number) +
                                                ": needs FRAMES FORWARD RIGHT "
                                                "TURN TILT RUN WAVE HOUR, as \"30 1 0 0 0 0 0 -1\"");
        input.is_running = is_running != 0;
        input.is_waving = is_waving != 0;
        frames_.insert(frames_.end(), count, frame);
    }
    check(!frames_.empty(), path + ": has no frames");
}

Input Recording::at(size_t frame, float& hour) const
{
    const Frame& now = frames_[std::min(frame, frames_.size() - 1)];
    const bool is_new = frame < frames_.size() && (frame == 0 || frames_[frame - 1].hour != now.hour);
    if (is_new && now.hour >= 0)
        hour = now.hour;
    return now.input;
}

} // namespace game
