#pragma once

#include <functional>
#include <utility>
#include <vector>

/** A multicast delegate. Handlers that are added during a broadcast are called from the next one on. */
template <typename... A> class TStubDelegate
{
public:
	template <typename O, typename C> void AddDynamic(O* Object, void (C::*Function)(A...))
	{
		Handlers.push_back({Object, [Object, Function](A... Arguments) { (Object->*Function)(Arguments...); }});
	}
	template <typename O, typename C> void AddUObject(O* Object, void (C::*Function)(A...)) { AddDynamic(Object, Function); }
	void AddLambda(std::function<void(A...)> Function) { Handlers.push_back({nullptr, std::move(Function)}); }
	void RemoveAll(const void* Object)
	{
		std::erase_if(Handlers, [Object](const auto& Handler) { return Handler.first == Object; });
	}
	void Clear() { Handlers.clear(); }
	bool IsBound() const { return !Handlers.empty(); }
	void Broadcast(A... Arguments) const
	{
		const auto Copy = Handlers;
		for (const auto& Handler : Copy) Handler.second(Arguments...);
	}

private:
	std::vector<std::pair<const void*, std::function<void(A...)>>> Handlers;
};

#define DECLARE_DYNAMIC_MULTICAST_DELEGATE(Name) class Name : public TStubDelegate<> {};
#define DECLARE_DYNAMIC_MULTICAST_DELEGATE_OneParam(Name, Type, Parameter) class Name : public TStubDelegate<Type> {};
