#include "service/key_cache.h"

#include <map>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "service/api_key.h"
#include "service/storage/ids.h"

namespace gaitmill {
namespace {

constexpr std::chrono::hours kForever{1000};
constexpr std::chrono::milliseconds kNever{0};

class KeyCacheTest : public ::testing::Test {
 protected:
  KeyCache makeCache(KeyPolicy policy, std::chrono::milliseconds max_age) {
    KeyLookup lookup;
    lookup.find = [this](const std::string& hash) -> std::optional<api::KeyView> {
      ++look_ups_;
      require(!broken_, ErrorCode::kStorage, "no disk");
      const auto found = stored_.find(hash);
      return found == stored_.end() ? std::nullopt : std::optional<api::KeyView>(found->second);
    };
    lookup.version = [this] {
      require(!broken_, ErrorCode::kStorage, "no disk");
      return version_;
    };
    return KeyCache(lookup, policy, max_age);
  }
  std::string addKey(const std::string& tenant) {
    api::KeyView key;
    key.id = makeId("key_");
    key.tenant = tenant;
    key.scopes = {"read"};
    const NewSecret secret = makeSecret();
    stored_[secret.sha256] = key;
    ++version_;
    return "Bearer " + makeToken(key.id, secret.letters);
  }
  void revokeAll() {
    stored_.clear();
    ++version_;
  }

  std::map<std::string, api::KeyView> stored_;
  std::int64_t version_ = 0;
  int look_ups_ = 0;
  bool broken_ = false;
};

TEST_F(KeyCacheTest, KeySpeaksForItsTenantWithItsScopes) {
  addKey("gait lab");
  const std::string header = addKey("sports lab");
  KeyCache cache = makeCache(KeyPolicy::kKeysRequired, kForever);
  const auto identity = cache.authenticate(header);
  ASSERT_TRUE(identity);
  EXPECT_EQ(identity->tenant, "sports lab");
  EXPECT_TRUE(identity->may_read);
  EXPECT_FALSE(identity->may_write);
  EXPECT_FALSE(identity->may_administer);
  EXPECT_FALSE(cache.authenticate(""));
  EXPECT_FALSE(cache.authenticate("Bearer " + makeToken(makeId("key_"), makeSecret().letters)));
}

TEST_F(KeyCacheTest, IdOfOneKeyWithSecretOfAnotherIsNobody) {
  const std::string first = addKey("a");
  const std::string second = addKey("b");
  const std::size_t secret_begins = first.size() - 52;
  const std::string mixed = first.substr(0, secret_begins) + second.substr(secret_begins);
  KeyCache cache = makeCache(KeyPolicy::kKeysRequired, kForever);
  EXPECT_FALSE(cache.authenticate(mixed)) << "keys not used before";
  EXPECT_TRUE(cache.authenticate(first));
  EXPECT_TRUE(cache.authenticate(second));
  EXPECT_FALSE(cache.authenticate(mixed)) << "keys in memory";
}

TEST_F(KeyCacheTest, ManyRequestsLookUpOnce) {
  const std::string header = addKey("a");
  KeyCache cache = makeCache(KeyPolicy::kKeysRequired, kNever);
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(cache.authenticate(header));
  }
  EXPECT_EQ(look_ups_, 1);
}

TEST_F(KeyCacheTest, RevokedHereIsRefusedAtTheNextRequest) {
  const std::string header = addKey("a");
  KeyCache cache = makeCache(KeyPolicy::kKeysRequired, kForever);
  EXPECT_TRUE(cache.authenticate(header));
  revokeAll();
  EXPECT_TRUE(cache.authenticate(header)) << "nobody said that the keys changed";
  cache.expire();
  EXPECT_FALSE(cache.authenticate(header));
}

TEST_F(KeyCacheTest, RevokedByAnotherProcessIsRefusedOnceTheKeysAreOld) {
  const std::string header = addKey("a");
  KeyCache cache = makeCache(KeyPolicy::kKeysRequired, kNever);
  EXPECT_TRUE(cache.authenticate(header));
  revokeAll();
  EXPECT_FALSE(cache.authenticate(header));
}

TEST_F(KeyCacheTest, ServiceWithoutKeysIsOpenUntilTheFirstAndNeverAgain) {
  KeyCache cache = makeCache(KeyPolicy::kOpenWithoutKeys, kNever);
  EXPECT_EQ(cache.authenticate("")->tenant, "local");
  const std::string header = addKey("a");
  EXPECT_FALSE(cache.authenticate(""));
  EXPECT_TRUE(cache.authenticate(header));
  revokeAll();
  EXPECT_FALSE(cache.authenticate(""));
  EXPECT_FALSE(cache.authenticate(header));
}

TEST_F(KeyCacheTest, WithoutKeysNobodyIsServedWhereTheyAreRequired) {
  EXPECT_FALSE(makeCache(KeyPolicy::kKeysRequired, kNever).authenticate(""));
}

TEST_F(KeyCacheTest, StorageThatCannotBeReadLetsNobodyNewIn) {
  const std::string header = addKey("a");
  KeyCache cache = makeCache(KeyPolicy::kOpenWithoutKeys, kNever);
  EXPECT_TRUE(cache.authenticate(header));
  broken_ = true;
  EXPECT_TRUE(cache.authenticate(header)) << "known before";
  EXPECT_FALSE(cache.authenticate(""));
  KeyCache fresh = makeCache(KeyPolicy::kOpenWithoutKeys, kNever);
  EXPECT_FALSE(fresh.authenticate("")) << "whether there are keys is not known";
  EXPECT_FALSE(fresh.authenticate(header));
}

}  // namespace
}  // namespace gaitmill
