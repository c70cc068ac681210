/// The numbers of bodies and contacts are limited, and the limits told.
#include <gtest/gtest.h>

#include <string>

#include "pairs/found_contacts.h"
#include "world/limits.h"

namespace cairn {
namespace {

TEST(ContactLimit, IsToldWithTheNumberAndARemedy) {
    EXPECT_NO_THROW(requireContacts(0));
    EXPECT_NO_THROW(requireContacts(most_contacts));
    try {
        requireContacts(most_contacts + 1);
        FAIL() << "a contact too many was taken";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("2000000001 contacts"), std::string::npos) << text;
        EXPECT_NE(text.find("2000000000 are the most"), std::string::npos) << text;
        EXPECT_NE(text.find("remove bodies"), std::string::npos) << text;
    }
}

TEST(BodyLimit, IsToldWithTheNumberAndARemedy) {
    EXPECT_NO_THROW(requireRoom(most_bodies - 1));
    try {
        requireRoom(most_bodies);
        FAIL() << "a body too many was taken";
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("at most 100000000"), std::string::npos) << text;
        EXPECT_NE(text.find("remove bodies"), std::string::npos) << text;
    }
}

/// 32 bits number the contacts.
static_assert(most_contacts < UINT32_MAX);

}  // namespace
}  // namespace cairn
