// The main function of every suite, compiled once per suite.
#define CATCH_CONFIG_MAIN
#include <catch2/catch.hpp>
