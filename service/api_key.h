#pragma once

#include <optional>
#include <string>

namespace gaitmill {

/// The secret half of a new API key. Only its hash is kept.
struct NewSecret {
  std::string letters;  ///< 52 letters of base 32, 256 random bits
  std::string sha256;   ///< hex, of the letters
};

/// @throws Error kInternal if the machine gives no random bytes
NewSecret makeSecret();

/// What the key's owner shows: "gm_<26 letters of the id>_<secret>".
/// @param key_id  as by makeId("key_")
std::string makeToken(const std::string& key_id, const std::string& secret);

/// What a client shows: the key it names, and the proof.
struct PresentedKey {
  std::string id;
  std::string secret;
};

/// Reads "Bearer gm_…" (the scheme in any case). @returns nullopt for anything else
std::optional<PresentedKey> parseAuthorization(const std::string& header);

/// Whether the secret has this hash; takes the same time wherever the two differ.
bool matchesSecret(const std::string& secret, const std::string& secret_sha256);

}  // namespace gaitmill
