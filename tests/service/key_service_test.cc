#include "service/key_service.h"

#include <sstream>

#include <gtest/gtest.h>

#include "service/keys_command.h"
#include "tests/service/expect_error.h"
#include "tests/service/port_fixture.h"

namespace gaitmill {
namespace {

class KeyServiceTest : public ::testing::Test {
 protected:
  api::KeyPort& keys() { return fixture_.ports().keys; }
  std::optional<api::Identity> authenticate(const std::string& token) {
    return fixture_.services().keyCache().authenticate("Bearer " + token);
  }

  PortFixture fixture_;
  const api::Identity who_ = makeMember("gait lab");
};

TEST_F(KeyServiceTest, NewKeyWorksAtOnceAndShowsItsSecretOnce) {
  const api::KeyView key = keys().add(who_, "lab computer", {"write", "read", "read"});
  EXPECT_EQ(key.scopes, (std::vector<std::string>{"read", "write"}));
  const auto identity = authenticate(key.secret);
  ASSERT_TRUE(identity);
  EXPECT_EQ(identity->tenant, "gait lab");
  EXPECT_EQ(identity->key_id, key.id);
  EXPECT_TRUE(identity->may_write);
  EXPECT_FALSE(identity->may_administer);
  const auto list = keys().list(who_);
  ASSERT_EQ(list.size(), 1U);
  EXPECT_EQ(list[0].name, "lab computer");
  EXPECT_EQ(list[0].secret, "");
}

TEST_F(KeyServiceTest, RevokedKeyIsRefusedAtOnce) {
  const api::KeyView key = keys().add(who_, "a", {"read"});
  EXPECT_TRUE(authenticate(key.secret));
  keys().revoke(who_, key.id);
  EXPECT_FALSE(authenticate(key.secret));
  EXPECT_NE(keys().list(who_)[0].revoked_at, 0);
}

TEST_F(KeyServiceTest, KeysOfAnotherTenantDoNotExist) {
  const api::KeyView key = keys().add(who_, "a", {"read"});
  const api::Identity other = makeMember("sports lab");
  EXPECT_TRUE(keys().list(other).empty());
  EXPECT_ERROR(keys().revoke(other, key.id), ErrorCode::kKeyNotFound);
  EXPECT_TRUE(authenticate(key.secret));
}

TEST_F(KeyServiceTest, ScopesThatDoNotExistAreRefused) {
  EXPECT_ERROR(keys().add(who_, "a", {}), ErrorCode::kRequestField);
  EXPECT_ERROR(keys().add(who_, "a", {"read", "root"}), ErrorCode::kRequestField);
}

// The command works on the database beside a service that has it open.
TEST_F(KeyServiceTest, CommandMakesListsAndRevokesKeys) {
  KeysOptions options;
  options.database = fixture_.folder() / "mill.db";
  CreateKeyOptions create;
  create.tenant = "sports lab";
  create.name = "treadmill";
  options.action = create;
  std::ostringstream made;
  manageKeys(options, made);
  std::string token;
  std::string line;
  for (std::istringstream lines(made.str()); std::getline(lines, line);) {
    token = line;
  }
  fixture_.services().keyCache().expire();
  const auto identity = authenticate(token);
  ASSERT_TRUE(identity) << made.str();
  EXPECT_EQ(identity->tenant, "sports lab");

  options.action = ListKeysOptions{};
  std::ostringstream listed;
  manageKeys(options, listed);
  EXPECT_NE(listed.str().find("treadmill"), std::string::npos);
  EXPECT_EQ(listed.str().find(token), std::string::npos);

  options.action = RevokeKeyOptions{identity->key_id};
  std::ostringstream revoked;
  manageKeys(options, revoked);
  fixture_.services().keyCache().expire();
  EXPECT_FALSE(authenticate(token));
  EXPECT_ERROR(manageKeys({options.database, RevokeKeyOptions{"key_absent"}}, revoked),
               ErrorCode::kKeyNotFound);
}

}  // namespace
}  // namespace gaitmill
