/// @file The piles of `cairn validate piles`: factors that are covered in pairs, a row for each, and what is missed.
#pragma once

#include <cstddef>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "validate/piles.h"

namespace cairn::validation {

/// At least 120 piles, among which every two values of two factors that go together occur: the same in every run.
/// @source pairwise testing: Cohen, Dalal, Fredman, Patton: The AETG system, IEEE Trans. Softw. Eng. 23 (1997)
std::vector<Pile> pileSuite();

/// The first 24 of the small ones, for the tests and for a first look: frictionless only where they are three deep, and
/// of round shapes three deep only frictionless ones of about one size.
std::vector<Pile> quickPiles();

/// Every n-th pile, beginning with the i-th, so that machines can share the work. @param part from 1 to parts
/// @throws InputError outside the range
std::vector<Pile> partOf(const std::vector<Pile>& piles, std::size_t part, std::size_t parts);

/// Runs piles, the largest first, and as many side by side as there are threads, which changes nothing but times.
/// @param threads ≥ 1 @param alive called in every step of every pile; what it throws ends all of them and is thrown
/// @param done told the place of each pile and its result as it ends, by one thread at a time; likewise
void runPiles(const std::vector<Pile>& piles, std::size_t threads, const std::function<void()>& alive,
              const std::function<void(std::size_t, const PileResult&)>& done);

/// What a result misses, in words; empty if it meets all bounds.
std::vector<std::string> missedBy(const Pile& pile, const PileResult& result);

/// A line for a person.
std::string lineOf(const Pile& pile, const PileResult& result);
/// The factors, the seed, the measured values and what is missed.
nlohmann::ordered_json rowOf(const Pile& pile, const PileResult& result);

}  // namespace cairn::validation
