// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "core/base/vector.hpp"

#include <cstdint>
#include <optional>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace talus
{

/// A saved state that is not whole or not of this kind; what() is a sentence.
struct ArchiveError : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// The bytes of everything that changes in a run, in order: `archive(a, b, …)` stores its arguments, or puts back what
/// was stored, so that whoever has a state describes it once for both ways:
///
///   void persist(Archive& archive) { archive(position, motion, time); }
///
/// Numbers are kept as their bits, on this machine's byte order. Taken are numbers, enumerations, Vec3, strings, random
/// generators, pairs, optionals and vectors of such, structures of plain numbers, and all that has a `persist`.
class Archive
{
public:
    /// An archive to store into.
    Archive() = default;

    /// An archive to put back from.
    explicit Archive(std::string bytes) : bytes_(std::move(bytes)), reading_(true) {}

    bool reading() const { return reading_; }
    const std::string& bytes() const { return bytes_; }
    std::string take_bytes() { return std::move(bytes_); }

    /// Stores into the memory of these bytes, which are forgotten.
    void take_room(std::string bytes)
    {
        bytes.clear();
        bytes_ = std::move(bytes);
    }

    /// How many bytes have been put back.
    std::size_t position() const { return at_; }

    /// Whether everything has been put back.
    bool at_end() const { return at_ == bytes_.size(); }

    /// @throws ArchiveError where the bytes end too early
    template <class... Fields> void operator()(Fields&... fields) { (keep(fields), ...); }

private:
    std::string bytes_;
    std::size_t at_ = 0;
    bool reading_ = false;

    template <class T> static constexpr bool has_persist = requires(T& t, Archive& archive) { t.persist(archive); };

    void raw(void* data, std::size_t size);
    /// @throws ArchiveError where fewer bytes are left than so many elements take
    void require(std::size_t count, std::size_t size_of_one = 1) const;

    template <class Field> void keep(Field& field)
    {
        if constexpr (has_persist<Field>)
            field.persist(*this);
        else {
            static_assert(std::is_trivially_copyable_v<Field> && !std::is_pointer_v<Field>,
                "give the structure a persist function");
            raw(&field, sizeof field);
        }
    }

    /// A byte that is not 0 or 1 is no truth value.
    void keep(bool& truth)
    {
        std::uint8_t byte = truth ? 1 : 0;
        raw(&byte, 1);
        truth = byte != 0;
    }

    void keep(Vec3& vector) { raw(vector.data(), 3 * sizeof(double)); }
    void keep(Box& box) { operator()(box.min, box.max); }

    void keep(std::string& text)
    {
        resize(text, 1);
        raw(text.data(), text.size());
    }

    void keep(std::mt19937_64& random)
    {
        std::ostringstream out;
        out << random;
        std::string text = out.str();
        keep(text);
        std::istringstream(text) >> random;
    }

    template <class A, class B> void keep(std::pair<A, B>& pair) { operator()(pair.first, pair.second); }

    template <class Value> void keep(std::optional<Value>& value)
    {
        bool present = value.has_value();
        keep(present);
        if (reading_) value = present ? std::optional<Value>(Value{}) : std::nullopt;
        if (present) keep(*value);
    }

    template <class Element> void keep(std::vector<Element>& list)
    {
        constexpr bool plain = std::is_trivially_copyable_v<Element> && !has_persist<Element>;
        resize(list, plain ? sizeof(Element) : 1);
        if constexpr (plain)
            raw(list.data(), list.size() * sizeof(Element));
        else
            for (auto& element : list) keep(element);
    }

    /// The size of a list.
    /// @param least bytes that an element takes
    template <class List> void resize(List& list, std::size_t least)
    {
        std::uint64_t size = list.size();
        raw(&size, sizeof size);
        if (!reading_) return;
        require(static_cast<std::size_t>(size), least);
        list.resize(static_cast<std::size_t>(size));
    }
};

} // namespace talus
