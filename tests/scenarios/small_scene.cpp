// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/scenarios/small_scene.hpp"

namespace talus::test
{

scene::RegionTable box_region(const Vec3& min, const Vec3& max)
{
    scene::RegionTable region;
    region.min = min;
    region.max = max;
    return region;
}

scene::Scene small_scene()
{
    scene::Scene scene;
    scene.materials.push_back({"glass", 2500.0});
    scene::ContactTable contact;
    contact.between = {"glass", "glass"};
    scene.contact.push_back(contact);

    scene::FillTable fill;
    fill.material = "glass";
    fill.count = 20;
    fill.diameter.value = 0.01;
    fill.region = box_region(Vec3::Zero(), Vec3(0.05, 0.05, 0.1));
    scene.fill.push_back(fill);

    scene::WallTable box;
    box.name = "box";
    box.shape = "box";
    box.material = "glass";
    box.max = Vec3(0.05, 0.05, 0.2);
    box.open = {"z+"};
    scene.wall.push_back(box);
    return scene;
}

scene::PourTable small_pour()
{
    scene::PourTable pour;
    pour.material = "glass";
    pour.count = 5;
    pour.rate = 100.0;
    pour.diameter.value = 0.01;
    pour.region = box_region(Vec3(0.01, 0.01, 0.15), Vec3(0.04, 0.04, 0.18));
    return pour;
}

scene::SensorTable sensor(const std::string& name, const std::string& kind)
{
    scene::SensorTable sensor;
    sensor.name = name;
    sensor.kind = kind;
    return sensor;
}

} // namespace talus::test
