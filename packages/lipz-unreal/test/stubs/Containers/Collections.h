#pragma once

#include "Containers/Strings.h"

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

template <typename T> class TArray
{
public:
	TArray() = default;
	TArray(std::initializer_list<T> Items) : Data(Items) {}
	int32 Num() const { return static_cast<int32>(Data.size()); }
	T* GetData() { return Data.data(); }
	const T* GetData() const { return Data.data(); }
	T& operator[](int32 Index) { return Data.at(static_cast<size_t>(Index)); }
	const T& operator[](int32 Index) const { return Data.at(static_cast<size_t>(Index)); }
	int32 Add(const T& Item) { Data.push_back(Item); return Num() - 1; }
	int32 Add(T&& Item) { Data.push_back(std::move(Item)); return Num() - 1; }
	void Append(const T* Items, int32 Count) { Data.insert(Data.end(), Items, Items + Count); }
	void Pop() { Data.pop_back(); }
	void Reset() { Data.clear(); }
	void Empty() { std::vector<T>().swap(Data); }
	void Init(const T& Item, int32 Count) { Data.assign(static_cast<size_t>(Count), Item); }
	void SetNumZeroed(int32 Count) { Data.resize(static_cast<size_t>(Count)); }
	bool Contains(const T& Item) const { return std::find(Data.begin(), Data.end(), Item) != Data.end(); }
	auto begin() { return Data.begin(); }
	auto end() { return Data.end(); }
	auto begin() const { return Data.begin(); }
	auto end() const { return Data.end(); }

private:
	std::vector<T> Data;
};

template <typename K, typename V> struct TPair
{
	TPair(K InKey, V InValue) : Key(std::move(InKey)), Value(std::move(InValue)) {}
	K Key;
	V Value;
};

template <typename K, typename V> class TMap
{
public:
	V& Add(const K& Key, const V& Value) { return FindOrAdd(Key) = Value; }
	V* Find(const K& Key)
	{
		for (auto& Pair : Pairs) if (Pair.Key == Key) return &Pair.Value;
		return nullptr;
	}
	const V* Find(const K& Key) const { return const_cast<TMap*>(this)->Find(Key); }
	V& FindOrAdd(const K& Key)
	{
		if (V* Found = Find(Key)) return *Found;
		Pairs.push_back(TPair<K, V>(Key, V()));
		return Pairs.back().Value;
	}
	int32 Num() const { return static_cast<int32>(Pairs.size()); }
	void Reset() { Pairs.clear(); }
	auto begin() const { return Pairs.begin(); }
	auto end() const { return Pairs.end(); }

private:
	std::vector<TPair<K, V>> Pairs;
};

template <typename T> std::remove_reference_t<T>&& MoveTemp(T&& Value) { return static_cast<std::remove_reference_t<T>&&>(Value); }
