// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/archive.hpp"
#include "io/scene/scene_file.hpp"

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace talus
{

/// The run that a checkpoint belongs to: what of it must not change, or the state would not fit.
struct RunOrigin {
    std::string scene_name;
    std::string scene;                ///< resolved, as TOML; as it stands in the run's folder
    std::vector<std::uint32_t> files; ///< checksums of those that it names

    void persist(Archive& archive) { archive(scene_name, scene, files); }
};

RunOrigin origin_of(const std::string& scene_name, const scene::Scene& scene);

/// Refuses a scene that differs from that of the checkpoint in more than a resumed run may change.
/// @throws InputError with the key and what may change, or with the file that is another one now
void refuse_other_scene(const SceneFile& file, const RunOrigin& origin);

/// The same where a state is put into a simulation of a scene, perhaps under another setting: what spheres and walls
/// there are must not change, since the state has them.
/// @param own of the simulation; @param origin of the state; @throws InputError
void refuse_other_state(const RunOrigin& own, const RunOrigin& origin);

} // namespace talus
