// Wishes of the player: from keyboard and gamepad, or from a recording.
// SPDX-License-Identifier: LicenseRef-Hearth-Undecided
#pragma once

#include <string>
#include <vector>

namespace game
{

struct Input
{
    float forward = 0, right = 0; ///< of the character as the camera sees it, -1 to 1
    float turn = 0, tilt = 0;     ///< of the camera, -1 to 1
    bool is_running = false, is_waving = false;
};

/// Read keyboard and gamepad as they are now.
Input readDevices();

/// Inputs of a recording and the hour of day, by frame. Each line of the file has, separated by blanks: how
/// many frames it lasts; forward, right, turn, tilt; 1 or 0 for running and for waving; the hour from 0 to
/// 24, or -1: as before. Lines that begin with # are comments.
class Recording
{
public:
    explicit Recording(const std::string& path);
    /// Return the input of a frame; beyond the end that of the last one.
    /// hour  changes where the recording says so
    Input at(size_t frame, float& hour) const;

private:
    struct Frame
    {
        Input input;
        float hour;
    };
    std::vector<Frame> frames_;
};

} // namespace game
