// The cost of a rendered frame: time, and bytes of memory.

#include "Stage.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <new>

static const int Rounds = 10;

static size_t Allocated = 0;

void* operator new(size_t Size)
{
	Allocated += Size;
	void* Block = std::malloc(Size);
	if (Block == nullptr) std::abort();
	return Block;
}

void operator delete(void* Block) noexcept { std::free(Block); }
void operator delete(void* Block, size_t) noexcept { std::free(Block); }

static void Measure(const char* Name, FStage& Stage, const TCHAR* Key, int Frames)
{
	Stage.Player->Begin(Key);
	Stage.Player->AdvanceTo(0.5f);
	const size_t Before = Allocated;
	double Least = std::numeric_limits<double>::max();
	for (int Round = 0; Round < Rounds; Round++)
	{
		const auto Start = std::chrono::steady_clock::now();
		for (int Frame = 0; Frame < Frames; Frame++) Stage.Player->AdvanceTo(0.5f + 0.5f * static_cast<float>(Round * Frames + Frame) / static_cast<float>(Rounds * Frames));
		const std::chrono::duration<double, std::nano> Time = std::chrono::steady_clock::now() - Start;
		Least = std::min(Least, Time.count() / Frames);
	}
	const size_t Used = Allocated - Before;
	std::printf("bench %s_ns %.1f Unreal player\nbench %s_bytes %zu Unreal player\n", Name, Least, Name, Used);
	EXPECT(Used == 0);
}

void TestFrames()
{
	const int Frames = 10000;
	FStage Visemes("drama", {"A", "E", "F", "L", "M", "O", "S", "U", "W"});
	Measure("tick", Visemes, TEXT("act1/mara-good-evening"), Frames);
	FStage Rig("rigs", {"jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthSmileLeft", "mouthSmileRight", "eyeBlinkLeft"});
	Rig.Player->Rig = TEXT("arkit");
	Measure("weights", Rig, TEXT("english"), Frames);
}
