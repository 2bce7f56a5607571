#!/usr/bin/env bash
# Runs the property tests with one new seed after another, until one fails or somebody stops it.
#
#   tools/fuzz.sh TREE [FIRST_SEED]
#
# MEDIAL_PROPERTY_COUNT is the number of polygons for each seed (2000 here).
set -euo pipefail
tree=$1
seed=${2:-$(date +%s)}
export MEDIAL_PROPERTY_COUNT=${MEDIAL_PROPERTY_COUNT:-2000}
for ((;; seed++)); do
  echo "fuzz: seed $seed, $MEDIAL_PROPERTY_COUNT polygons"
  MEDIAL_PROPERTY_SEED=$seed "$tree/tests/property_test" --gtest_brief=1 || {
    echo "fuzz: failed; again with: MEDIAL_PROPERTY_SEED=$seed $tree/tests/property_test" >&2
    exit 1
  }
done
