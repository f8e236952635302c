#include "tests/service/storage/storage_fixture.h"

#include <random>

namespace gaitmill {

std::string makeNoise(std::size_t size, unsigned seed) {
  std::mt19937 random(seed);
  std::string noise(size, '\0');
  for (char& byte : noise) {
    byte = static_cast<char>(random() & 0xffU);
  }
  return noise;
}

std::int64_t queryInteger(Database& database, const char* sql) {
  const ReadTransaction db = database.read();
  Statement row = db->prepare(sql);
  row.step();
  return row.integer(0);
}

std::string queryText(Database& database, const char* sql) {
  const ReadTransaction db = database.read();
  Statement row = db->prepare(sql);
  row.step();
  return row.text(0);
}

void tamper(Database& database, const char* sql) {
  database.write([sql](Connection& db) { db.runScript(sql); });
}

}  // namespace gaitmill
