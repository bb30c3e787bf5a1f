// SPDX-License-Identifier: GPL-3.0-or-later
#include "app/study/workers.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <map>
#include <new>
#include <string>

#include <unistd.h>

using namespace talus;
using Catch::Matchers::Contains;

TEST_CASE("a task that crashes takes nothing with it", "[app][study]")
{
    std::map<std::size_t, std::string> heard, endings;
    const std::string long_words(1000000, 'x');
    run_in_copies(
        4, 2,
        [&](std::size_t task) -> std::string {
            if (task == 1) ::kill(::getpid(), SIGKILL);
            if (task == 2) throw std::bad_alloc();
            return task == 3 ? long_words : "words";
        },
        [&](std::size_t task, const std::string& words, const std::string& ending) {
            heard[task] = words;
            endings[task] = ending;
        },
        [] { return true; });
    CHECK(heard[0] == "words");
    CHECK(endings[0] == "");
    CHECK(endings[1] == "crashed: Killed");
    CHECK_THAT(endings[2], Contains("without a result"));
    CHECK(heard[3] == long_words);
}

TEST_CASE("tasks are ended where the study is not to go on", "[app][study]")
{
    int done = 0, asked = 0;
    run_in_copies(
        100, 2,
        [](std::size_t) -> std::string {
            ::sleep(100);
            return "";
        },
        [&](std::size_t, const std::string&, const std::string&) { ++done; }, [&] { return ++asked < 3; });
    CHECK(done == 0);
}
