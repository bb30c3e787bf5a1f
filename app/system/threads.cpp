// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/system/threads.hpp"

#include "app/system/terminal.hpp"

#include <fmt/format.h>

#include <omp.h>

#include <future>
#include <system_error>
#include <thread>
#include <vector>

namespace talus
{

void use_threads(int count)
{
    if (count > 0) omp_set_num_threads(count);
    // OpenMP ends the program where it gets no thread, so they are asked for here first.
    std::promise<void> end;
    const std::shared_future<void> ended = end.get_future().share();
    std::vector<std::jthread> threads;
    try {
        while (static_cast<int>(threads.size()) + 1 < omp_get_max_threads())
            threads.emplace_back([ended] { ended.wait(); });
        end.set_value();
    } catch (const std::system_error& refusal) {
        end.set_value();
        throw UsageError(fmt::format("of {} threads the system gives this process {}: {}; ask for fewer with --threads",
            omp_get_max_threads(), threads.size() + 1, refusal.code().message()));
    }
}

} // namespace talus
