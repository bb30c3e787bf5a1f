// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/phase_clock.hpp"

#include <ctime>

namespace talus
{
namespace
{

double seconds(clockid_t clock)
{
    timespec time;
    clock_gettime(clock, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

} // namespace

PhaseClock::PhaseClock() : start_(read()), last_(start_)
{
    for (const char* name : phase_names) phases_.push_back({name, 0.0, 0.0});
}

PhaseClock::Reading PhaseClock::read()
{
    return {seconds(CLOCK_MONOTONIC), seconds(CLOCK_PROCESS_CPUTIME_ID)};
}

void PhaseClock::begin(RunPhase phase)
{
    const Reading now = read();
    PhaseTime& ended = phases_[static_cast<std::size_t>(current_)];
    ended.wall += now.wall - last_.wall;
    ended.cpu += now.cpu - last_.cpu;
    last_ = now;
    current_ = phase;
}

void PhaseClock::persist(Archive& archive)
{
    for (PhaseTime& phase : phases_) archive(phase.wall, phase.cpu);
}

double PhaseClock::wall() const
{
    return seconds(CLOCK_MONOTONIC) - start_.wall;
}

} // namespace talus
