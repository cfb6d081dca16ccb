#pragma once

struct FPlatformTime
{
	static double Seconds() { return StubSeconds; }
	static inline double StubSeconds = 1000.0;
};
