// SPDX-License-Identifier: GPL-3.0-or-later
#include "io/scene/trial_run.hpp"
#include "io/text/input_error.hpp"
#include "tests/io/scene_folder.hpp"

#include <catch2/catch.hpp>

#include <csignal>
#include <cstdlib>
#include <vector>

using namespace talus;
using namespace talus::test;

namespace
{

std::string sentence_of(const std::function<void()>& act, int seconds = 10)
{
    constexpr std::size_t memory = std::size_t{64} << 20;
    return error_of<InputError>([&] { try_in_a_copy(act, {seconds, memory}, "crashed"); });
}

} // namespace

TEST_CASE("what is tried in a copy of the process changes nothing here", "[trial_run]")
{
    int answer = 0;
    CHECK(sentence_of([&] { answer = 42; }) == "no error");
    CHECK(answer == 0);
}

TEST_CASE("what is refused in a copy of the process is refused here", "[trial_run]")
{
    const std::string sentence(100000, 'x'); // more than a pipe holds
    CHECK(sentence_of([&] { throw InputError(sentence); }) == sentence);
}

TEST_CASE(
    "what crashes, leaves, never ends or wants too much in a copy of the process does not do so here", "[trial_run]")
{
    CHECK(sentence_of([] { std::abort(); }) == "crashed");
    CHECK(sentence_of([] { std::raise(SIGSEGV); }) == "crashed");
    CHECK(sentence_of([] { std::_Exit(0); }) == "crashed");
    CHECK(sentence_of([] { throw std::vector<char>(std::size_t{1} << 30).back(); }) == "crashed");
    volatile bool forever = true;
    CHECK(sentence_of(
              [&] {
                  while (forever) {}
              },
              1) == "crashed");
}
