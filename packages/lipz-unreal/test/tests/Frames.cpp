// The cost of a rendered frame: time, and blocks of memory.

#include "Stage.h"

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <new>

static size_t Blocks = 0;

void* operator new(size_t Size)
{
	Blocks++;
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
	const size_t Before = Blocks;
	const auto Start = std::chrono::steady_clock::now();
	for (int Frame = 0; Frame < Frames; Frame++) Stage.Player->AdvanceTo(0.5f + 0.5f * static_cast<float>(Frame) / static_cast<float>(Frames));
	const std::chrono::duration<double, std::nano> Time = std::chrono::steady_clock::now() - Start;
	const size_t Used = Blocks - Before;
	std::printf("%s: %.0f ns per rendered frame, %zu blocks in %d frames\n", Name, Time.count() / Frames, Used, Frames);
	EXPECT(Used == 0);
}

void TestFrames()
{
	const int Frames = 100000;
	FStage Visemes("drama", {"A", "E", "F", "L", "M", "O", "S", "U", "W"});
	Measure("visemes", Visemes, TEXT("act1/mara-good-evening"), Frames);
	FStage Rig("rigs", {"jawOpen", "mouthClose", "mouthFunnel", "mouthPucker", "mouthSmileLeft", "mouthSmileRight", "eyeBlinkLeft"});
	Rig.Player->Rig = TEXT("arkit");
	Measure("arkit", Rig, TEXT("english"), Frames);
}
